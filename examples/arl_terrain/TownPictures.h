// SPDX-License-Identifier: MIT
#pragma once
#include "ScenePicture.h"
#include "TownScene.h"

#include <filesystem>

namespace gnomon::examples {

/// Draws a town into memory.
class TownPictures {
public:
    /// @throws std::runtime_error, one sentence, if there is no OpenGL.
    explicit TownPictures(TownScene& town);

    osg::ref_ptr<osg::Image> draw();
    /// Morning, noon and evening, with each technique: NAME-TECHNIQUE.png.
    /// @throws std::runtime_error, one sentence, if the folder cannot be made or written to.
    void report(const std::filesystem::path& folder);

private:
    TownScene& _town;
    ScenePicture _picture;
};

} // namespace gnomon::examples
