// SPDX-License-Identifier: MIT
#include <support/DiscShadow.h>

#include <gnomon/ScreenPass.h>
#include <gnomon/compositor/ShadowJob.h>
#include <osg/GLExtensions>
#include <osg/Program>
#include <osg/State>

#include <algorithm>
#include <cmath>

namespace test {
namespace {

/// Discards what `keepBelow` does not exceed; alpha is the share that arrives.
constexpr const char* fragment = R"(#version 130
uniform vec2 centre, radii;
uniform float keepBelow;
void main() {
    float r = distance(gl_FragCoord.xy, centre);
    float share = radii.x < radii.y ? clamp((r - radii.x) / (radii.y - radii.x), 0.0, 1.0) : step(radii.x, r);
    if (share >= keepBelow) discard;
    gl_FragColor = vec4(0.0, 0.0, 0.0, share);
})";

osg::ref_ptr<osg::StateSet> programState() {
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, "void main() { gl_Position = gl_Vertex; }"));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment));
    osg::ref_ptr<osg::StateSet> set = new osg::StateSet;
    set->setAttribute(program);
    return set;
}

class DiscMark : public gnomon::Mark {
public:
    Kind kind() const override { return inner < outer ? Kind::Fades : Kind::Hard; }

    std::string draw(gnomon::ScreenPass& pass) const override {
        using Want = gnomon::ScreenPass::Want;
        ++*draws;
        osg::State& state = pass.state();
        state.apply(set.get());
        const auto* program = state.getLastAppliedProgramObject();
        const osg::GLExtensions& gl = *state.get<osg::GLExtensions>();
        const auto at = [&](const char* name) { return program->getUniformLocation(std::string(name)); };
        const Want want = pass.wanted();
        gl.glUniform2f(at("centre"), static_cast<float>(centre.x()), static_cast<float>(centre.y()));
        gl.glUniform2f(at("radii"), static_cast<float>(inner), static_cast<float>(outer));
        gl.glUniform1f(at("keepBelow"), want == Want::Blocked ? 0.5f : want == Want::Touched ? 1.0f : 2.0f);
        pass.testDepth(GL_GREATER); // nothing at far depth
        pass.drawQuad(1.0);
        glDisable(GL_DEPTH_TEST);
        state.apply();
        return "";
    }

    osg::Vec2d centre;
    double inner = 0.0, outer = 0.0;
    std::shared_ptr<std::atomic<int>> draws;
    osg::ref_ptr<osg::StateSet> set = programState();
};

osg::ref_ptr<gnomon::Mark> markOf(const DiscShadow& disc) {
    osg::ref_ptr<DiscMark> mark = new DiscMark;
    mark->centre = disc.centre;
    mark->inner = disc.inner;
    mark->outer = disc.outer;
    mark->draws = disc.draws;
    const auto place = [&](double x, double y) {
        return glm::dvec2(std::clamp(2.0 * x / disc.size.x() - 1.0, -1.0, 1.0),
                          std::clamp(2.0 * y / disc.size.y() - 1.0, -1.0, 1.0));
    };
    mark->screenBounds = {place(disc.centre.x() - disc.outer, disc.centre.y() - disc.outer),
                          place(disc.centre.x() + disc.outer, disc.centre.y() + disc.outer)};
    return mark;
}

} // namespace

std::vector<osg::ref_ptr<gnomon::Mark>> DiscShadow::prepare(const gnomon::ViewFrame&, const gnomon::ShadowLight& light,
                                                            const gnomon::Casters&) const {
    if (!lights.empty() && !lights.count(light.number)) return {};
    return {markOf(*this)};
}

double DiscShadow::arriving(int x, int y) const {
    const double r = std::hypot(x + 0.5 - centre.x(), y + 0.5 - centre.y());
    return inner < outer ? std::clamp((r - inner) / (outer - inner), 0.0, 1.0) : (r >= inner ? 1.0 : 0.0);
}

} // namespace test
