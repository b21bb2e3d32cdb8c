// SPDX-License-Identifier: MIT
#pragma once
#include "SceneText.h"

#include <gtest/gtest.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <string>

namespace test {

template <typename Class>
Class& childOf(osg::Group& group, unsigned index) {
    return dynamic_cast<Class&>(*group.getChild(index));
}

/// A kind of scene file, by its suffix.
class SceneFile : public testing::TestWithParam<const char*> {
protected:
    static void SetUpTestSuite() { usePluginsOfThisBuild(); }
    std::string kind() const { return GetParam(); }

    /// The scene's group is given its light; through a file and back it must look the same, shadow and all.
    void expectSamePictureOnceLoaded(Scene& scene) const {
        scene.group->addLight(scene.light);
        const auto copy = throughFile(*scene.root, kind());
        ASSERT_TRUE(copy);
        const View view = perspective({-6.0, -8.0, 8.0}, {0.0, 0.0, 0.0});
        const Picture before = render(scene.root, view);
        EXPECT_EQ(render(copy, view).different(before), 0);
        scene.group->removeChild(1);
        EXPECT_GT(render(scene.root, view).different(before), 500) << "there is no shadow to compare";
    }
};

} // namespace test
