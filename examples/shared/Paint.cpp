// SPDX-License-Identifier: MIT
#include "Paint.h"

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/LightModel>
#include <osg/Material>

namespace gnomon::examples {
namespace {

osg::ref_ptr<osg::Material> matt(const osg::Vec4& color) {
    constexpr auto both = osg::Material::FRONT_AND_BACK;
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setAmbient(both, color);
    material->setDiffuse(both, color);
    material->setSpecular(both, osg::Vec4(0, 0, 0, 1));
    return material;
}

} // namespace

osg::ref_ptr<osg::Node> painted(osg::ref_ptr<osg::Node> node, const osg::Vec4& color) {
    node->getOrCreateStateSet()->setAttributeAndModes(matt(color));
    return node;
}

/// Lit by nothing but what it sends out itself, whatever colours its vertices have.
osg::ref_ptr<osg::Node> paintedUnlit(osg::ref_ptr<osg::Node> node, const osg::Vec4& color) {
    osg::ref_ptr<osg::Material> material = matt(osg::Vec4(0, 0, 0, 1));
    material->setEmission(osg::Material::FRONT_AND_BACK, color);
    node->getOrCreateStateSet()->setAttributeAndModes(material);
    return node;
}

osg::ref_ptr<osg::Texture2D> drawnTexture(int size, const std::function<osg::Vec3(int, int)>& color) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(size, size, 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column)
            image->setColor(osg::Vec4(color(column, row), 1.0f), static_cast<unsigned>(column),
                            static_cast<unsigned>(row));
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    for (const auto side : {osg::Texture::WRAP_S, osg::Texture::WRAP_T}) texture->setWrap(side, osg::Texture::REPEAT);
    for (const auto use : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER})
        texture->setFilter(use, osg::Texture::NEAREST);
    return texture;
}

osg::ref_ptr<osg::Node> texturedQuad(const osg::Vec3d& corner, const osg::Vec3d& side, const osg::Vec3d& up,
                                     double repeats) {
    const auto last = static_cast<float>(repeats);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(osg::createTexturedQuadGeometry(osg::Vec3(corner), osg::Vec3(side), osg::Vec3(up), last, last));
    return geode;
}

osg::ref_ptr<osg::LightSource> addLight(osg::Group& root, const osg::Vec4d& place) {
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    osg::Light& light = *source->getLight();
    light.setPosition(osg::Vec4(place));
    light.setAmbient(osg::Vec4(0, 0, 0, 1));
    light.setDiffuse(osg::Vec4(1, 1, 1, 1));
    light.setSpecular(osg::Vec4(0, 0, 0, 1));
    root.addChild(source);
    osg::StateSet& set = *root.getOrCreateStateSet();
    osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
    model->setAmbientIntensity(osg::Vec4(0.2f, 0.2f, 0.2f, 1.0f));
    set.setAttributeAndModes(model);
    for (const GLenum mode : {GLenum(GL_LIGHTING), GLenum(GL_LIGHT0), GLenum(GL_NORMALIZE)})
        set.setMode(mode, osg::StateAttribute::ON);
    return source;
}

} // namespace gnomon::examples
