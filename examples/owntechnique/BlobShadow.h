// SPDX-License-Identifier: MIT
// A technique of one's own: a soft disc behind each caster, as games had it before there were maps.
#pragma once
#include <gnomon/MarkProgram.h>
#include <gnomon/ShadowTechnique.h>
#include <gnomon/ViewFrame.h>

#include <osg/Uniform>

#include <algorithm>
#include <vector>

/// What share of the light the balls let through, by whose middle the light passes: from half of a radius on.
constexpr const char* behindBalls = R"(
uniform vec4 balls[64]; // middle, and radius
uniform int count;
uniform vec4 light;     // w = 0: the way towards a sun; w = 1: a lamp's place
float arrivesAt(vec3 place) {
    vec3 way = normalize(light.xyz - light.w * place);
    float arrives = 1.0;
    for (int i = 0; i < count; ++i) {
        vec3 to = balls[i].xyz - place;
        float along = dot(to, way), beside = length(to - along * way) / balls[i].w;
        if (along > 0.0) arrives = min(arrives, smoothstep(0.5, 1.0, beside));
    }
    return arrives;
})";

class BlobMark : public gnomon::Mark {
public:
    Kind kind() const override { return Kind::Fades; }
    BlobMark() { canDarken = true; } // a MarkProgram can
    std::string draw(gnomon::ScreenPass& pass) const override { return program->draw(pass, clipFromScene, *uniforms); }

    osg::ref_ptr<const gnomon::MarkProgram> program;
    osg::Matrixd clipFromScene;
    osg::ref_ptr<osg::StateSet> uniforms = new osg::StateSet;
};

/// Takes each caster for a ball as wide as its box.
class BlobShadow : public gnomon::ShadowTechnique {
public:
    BlobShadow() = default;
    BlobShadow(const BlobShadow& other, const osg::CopyOp& copyOp) : ShadowTechnique(other, copyOp) {}
    META_Node(examples, BlobShadow)

    std::vector<osg::ref_ptr<gnomon::Mark>> prepare(const gnomon::ViewFrame& view, const gnomon::ShadowLight& light,
                                                    const gnomon::Casters& casters) const override {
        constexpr unsigned most = 64;
        std::vector<gnomon::CasterBox> boxes = gnomon::boxesOf(casters);
        if (boxes.size() > most) {
            report(view.frameNumber, "only 64 casters have a blob. Use map, or name fewer casters.");
            boxes.resize(most);
        }
        if (boxes.empty()) return {};
        const osg::Vec3d origin = boxes.front().inGroup.center(); // floats are fine about it
        osg::ref_ptr<osg::Uniform> balls = new osg::Uniform(osg::Uniform::FLOAT_VEC4, "balls", most);
        osg::ref_ptr<BlobMark> mark = new BlobMark;
        std::optional<gnomon::ScreenRect> bounds;
        for (unsigned i = 0; i < boxes.size(); ++i) {
            const osg::BoundingBoxd& box = boxes[i].inGroup;
            const double radius = std::max(box.xMax() - box.xMin(), box.yMax() - box.yMin()) / 2.0;
            balls->setElement(i, osg::Vec4f(box.center() - origin, float(radius)));
            const auto place = view.boundsBehind(box, light);
            if (place) bounds = bounds ? united(*bounds, *place) : *place;
        }
        if (!bounds) return {}; // out of sight: nothing to say
        const double w = light.inGroup.w();
        const osg::Vec3d at(light.inGroup.x(), light.inGroup.y(), light.inGroup.z());
        mark->screenBounds = *bounds;
        mark->program = _program;
        mark->clipFromScene = osg::Matrixd::translate(origin) * view.clipFromGroup();
        mark->uniforms->addUniform(balls);
        mark->uniforms->addUniform(new osg::Uniform("count", int(boxes.size())));
        mark->uniforms->addUniform(
            new osg::Uniform("light", osg::Vec4f(w == 0.0 ? at : at / w - origin, w == 0.0 ? 0.0f : 1.0f)));
        return {mark};
    }

    void resizeGLObjectBuffers(unsigned maxSize) override {
        ShadowTechnique::resizeGLObjectBuffers(maxSize);
        _program->resizeGLObjectBuffers(maxSize);
    }
    void releaseGLObjects(osg::State* state = nullptr) const override {
        ShadowTechnique::releaseGLObjects(state);
        _program->releaseGLObjects(state);
    }

protected:
    ~BlobShadow() override = default;

private:
    const osg::ref_ptr<gnomon::MarkProgram> _program = new gnomon::MarkProgram(behindBalls);
};
