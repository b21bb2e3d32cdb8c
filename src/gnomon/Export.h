// SPDX-License-Identifier: MIT
#pragma once
/// GNOMON_EXPORT marks the classes and functions that the library exports.
#if defined(_WIN32)
#if defined(gnomon_EXPORTS)
#define GNOMON_EXPORT __declspec(dllexport)
#else
#define GNOMON_EXPORT __declspec(dllimport)
#endif
#else
#define GNOMON_EXPORT __attribute__((visibility("default")))
#endif
