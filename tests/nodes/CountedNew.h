// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>

/// How often `operator new` has been called in this program, by any library and thread.
std::size_t countedNews();
