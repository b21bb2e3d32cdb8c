// SPDX-License-Identifier: MIT
#include <gnomon/BoxShadow.h>
#include <gnomon/Convert.h>
#include <gnomon/casters/CasterExtraction.h>
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/ground/BoxMethod.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/terrain/CasterTiles.h>

#include <osg/MatrixTransform>
#include <osg/PolygonOffset>

namespace gnomon {
namespace {

/// Drawn before the ground that it lies on.
osg::ref_ptr<osg::StateSet> asShadow() {
    osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
    state->setMode(GL_LIGHTING, osg::StateAttribute::OFF | osg::StateAttribute::PROTECTED);
    state->setMode(GL_BLEND, osg::StateAttribute::ON);
    state->setTextureMode(0, GL_TEXTURE_2D, osg::StateAttribute::OFF | osg::StateAttribute::PROTECTED);
    state->setAttributeAndModes(new osg::PolygonOffset(-1.0f, -1.0f));
    state->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    return state;
}

} // namespace

osg::ref_ptr<osg::Geometry> boxShadow(const BoxShadowObject& object, const Ground& terrain, const osg::Vec4d& light) {
    const auto usable = lightInScene(light, SceneFrame(osg::Vec3d()));
    if (!object.graphic || !usable || (usable->w == 0.0 && !(usable->z > 0.0))) return nullptr;
    const osg::ref_ptr<osg::MatrixTransform> placed =
        new osg::MatrixTransform(osg::Matrixd::rotate(osg::DegreesToRadians(object.heading), osg::Z_AXIS) *
                                 osg::Matrixd::translate(object.position));
    placed->addChild(object.graphic);
    CasterExtraction casters;
    placed->accept(casters);
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    const osg::ref_ptr<const CasterMesh> mesh = new CasterMesh(casters);
    for (BoxCaster& box : boxCastersOf(*mesh)) {
        if (object.bounds.valid()) {
            box.low = toGlm(object.bounds._min + object.position);
            box.high = toGlm(object.bounds._max + object.position);
        }
        if (const auto shadow = boxShadow(terrain, box, *usable))
            for (const glm::dvec3& corner : *shadow)
                vertices->push_back(osg::Vec3(osg::Vec3d(corner.x, corner.y, corner.z)));
    }
    if (vertices->empty()) return nullptr;
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    osg::ref_ptr<osg::Vec3Array> normal = new osg::Vec3Array;
    normal->push_back({0.0f, 0.0f, 1.0f});
    geometry->setNormalArray(normal, osg::Array::BIND_OVERALL);
    osg::ref_ptr<osg::Vec4Array> colour = new osg::Vec4Array;
    colour->push_back({0.0f, 0.0f, 0.0f, 0.5f});
    geometry->setColorArray(colour, osg::Array::BIND_OVERALL);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices->size())));
    geometry->setStateSet(asShadow());
    return geometry;
}

} // namespace gnomon
