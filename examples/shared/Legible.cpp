// SPDX-License-Identifier: MIT
#include "Legible.h"

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/PolygonMode>

namespace gnomon::examples {
namespace {

constexpr float helpWidth = 1280.0f, helpHeight = 1024.0f; // osgViewer::HelpHandler's own unit

} // namespace

void keepLegible(osg::StateSet& set) {
    constexpr auto always = osg::StateAttribute::PROTECTED;
    set.setAttribute(new osg::PolygonMode, always);
    set.setMode(GL_LIGHTING, osg::StateAttribute::OFF | always);
    set.setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF | always);
    set.setMode(GL_CULL_FACE, osg::StateAttribute::OFF | always);
    set.setTextureMode(0, GL_TEXTURE_2D, osg::StateAttribute::ON | always);
    set.setMode(GL_BLEND, osg::StateAttribute::ON | always);
}

void darkenBehind(osg::Camera& camera) {
    osg::ref_ptr<osg::Geometry> veil = osg::createTexturedQuadGeometry(
        osg::Vec3(-helpWidth, -helpHeight, 0.0f), osg::Vec3(3.0f * helpWidth, 0.0f, 0.0f), // wherever its text is moved
        osg::Vec3(0.0f, 3.0f * helpHeight, 0.0f));
    osg::ref_ptr<osg::Vec4Array> color = new osg::Vec4Array(osg::Array::BIND_OVERALL);
    color->push_back(osg::Vec4(0.0f, 0.0f, 0.0f, 0.75f));
    veil->setColorArray(color);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(veil);
    keepLegible(*geode->getOrCreateStateSet());
    geode->getStateSet()->setRenderBinDetails(-1, "RenderBin");
    camera.addChild(geode);
}

} // namespace gnomon::examples
