// SPDX-License-Identifier: MIT
#pragma once
#if defined(_WIN32)
#if defined(gnomon_EXPORTS)
#define GNOMON_EXPORT __declspec(dllexport)
#else
#define GNOMON_EXPORT __declspec(dllimport)
#endif
#else
#define GNOMON_EXPORT __attribute__((visibility("default")))
#endif
