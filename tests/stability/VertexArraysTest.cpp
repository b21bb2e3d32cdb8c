// SPDX-License-Identifier: MIT
// A frame leaves no vertex array on that the same frame without shadows leaves off: what a program then draws by OpenGL's
// own calls would read the kit's buffers, which may be gone.
#include "Trial.h"

#include <osg/Camera>
#include <osg/GLExtensions>
#include <osgViewer/Viewer>

#include <algorithm>
#include <set>
#include <string>

using namespace test;

namespace {

/// The arrays that are on when a camera has drawn all.
class Arrays : public osg::Camera::DrawCallback {
public:
    void operator()(osg::RenderInfo&) const override {
        on.clear();
        using GetAttribute = void(GL_APIENTRY*)(GLuint, GLenum, GLint*);
        using ActiveTexture = void(GL_APIENTRY*)(GLenum);
        GetAttribute getAttribute = nullptr;
        ActiveTexture clientActiveTexture = nullptr;
        osg::setGLExtensionFuncPtr(getAttribute, "glGetVertexAttribiv");
        osg::setGLExtensionFuncPtr(clientActiveTexture, "glClientActiveTexture");
        for (const GLenum array : {GL_VERTEX_ARRAY, GL_NORMAL_ARRAY, GL_COLOR_ARRAY, GL_EDGE_FLAG_ARRAY})
            if (glIsEnabled(array)) on.insert("array " + std::to_string(array));
        for (GLenum unit = 0; unit < 8; ++unit) {
            clientActiveTexture(GL_TEXTURE0 + unit);
            if (glIsEnabled(GL_TEXTURE_COORD_ARRAY)) on.insert("texture coordinates " + std::to_string(unit));
        }
        clientActiveTexture(GL_TEXTURE0);
        for (GLuint place = 0; place < 16; ++place) {
            GLint enabled = 0;
            getAttribute(place, 0x8622, &enabled); // GL_VERTEX_ATTRIB_ARRAY_ENABLED
            if (enabled) on.insert("attribute " + std::to_string(place));
        }
    }
    mutable std::set<std::string> on;
};

std::set<std::string> onAfterFrames(const Scene& scene, const View& view) {
    Camera camera(scene.root, view);
    const osg::ref_ptr<Arrays> arrays = new Arrays;
    camera.viewer().getCamera()->setFinalDrawCallback(arrays);
    for (int frame = 1; frame <= 3; ++frame) camera.frame();
    return arrays->on;
}

/// The trial with the light on its other side.
Trial mirrored(Trial trial) {
    trial.light.x() = -trial.light.x();
    return trial;
}

GNOMON_BY_TECHNIQUE(VertexArrays);

} // namespace

TEST_P(VertexArrays, AreOnWhereTheyAreWithoutShadows) {
    Trial trial{{house({0.0, 0.0}, {2.0, 1.5, 1.0}, 30.0)}};
    trial.view = fromAbove(4.0, 64);
    Scene lit = trial.build(), shadowed = trial.buildWithShadow();
    for (const auto composite : {gnomon::ShadowCasterGroup::RELIGHT, gnomon::ShadowCasterGroup::BLEND}) {
        shadowed.group->setComposite(composite);
        const auto without = onAfterFrames(lit, trial.view), with = onAfterFrames(shadowed, trial.view);
        EXPECT_FALSE(without.empty()); // there is something to be seen
        EXPECT_TRUE(std::includes(without.begin(), without.end(), with.begin(), with.end()))
            << testing::PrintToString(with) << " instead of " << testing::PrintToString(without);
    }
}

/// OSG tells arrays by their addresses and takes one for another that was there before. Drawables in display lists set none
/// between.
TEST_P(VertexArrays, OfATechniqueThatIsGoneAreNotTakenForThoseOfTheNext) {
    Trial trial{{house({0.0, 0.0}, {2.0, 1.5, 1.0}, 30.0)}};
    trial.view = fromAbove(4.0, 64);
    const Truth truths[] = {truthOf(trial), truthOf(mirrored(trial))};
    for (const bool relights : {true, false}) {
        Scene scene = trial.build();
        osg::ref_ptr<gnomon::ShadowTechnique> technique = castingTechnique(find(*scene.root, "ground"));
        scene.addShadow(technique);
        scene.group->setComposite(relights ? gnomon::ShadowCasterGroup::RELIGHT : gnomon::ShadowCasterGroup::BLEND);
        scene.group->setDark(0.0f);
        Camera camera(scene.root, trial.view);
        for (int turn = 0; turn < 12; ++turn) {
            scene.light->getLight()->setPosition(turn % 2 ? mirrored(trial).light : trial.light);
            const Truth& truth = truths[turn % 2];
            ASSERT_TRUE(relights ? shows(camera.frame(), truth) : showsInBlack(camera.frame(), truth)) << turn;
            scene.group->removeChild(technique);
            technique = nullptr;
            technique = castingTechnique(find(*scene.root, "ground"));
            scene.group->addChild(technique);
        }
    }
}
