// SPDX-License-Identifier: MIT
#pragma once
#include "ShadowedScene.h"

#include <osgViewer/ViewerBase>

#include <functional>
#include <string>
#include <vector>

namespace gnomon::examples {

/// Draws one frame of a program again and again: without shadows, with every technique and both composites, and with
/// osgShadow::ShadowMap. The program's scene stands still meanwhile. Writes NAME.png a picture, and compare.json.
///
/// @param draw    draws a frame of `viewer` as the program does, without events and updates.
/// @param folder  for pictures and the table.
/// @param scenes  those that are shown.
/// @return a line each, for people.
/// @throws std::runtime_error, one sentence, if the program shows no window or a file cannot be written.
std::vector<std::string> drawSideBySide(osgViewer::ViewerBase& viewer, const std::function<void()>& draw,
                                        const std::string& folder, const std::vector<ShadowedScene*>& scenes);

} // namespace gnomon::examples
