// SPDX-License-Identifier: MIT
#include "Hud.h"

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/PolygonMode>
#include <osgViewer/View>

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

namespace {

constexpr float letterHeight = 14.0f, margin = 10.0f; // pixels

osg::ref_ptr<osgText::Text> makeText() {
    osg::ref_ptr<osgText::Text> text = new osgText::Text;
    text->setDataVariance(osg::Object::DYNAMIC);
    text->setCharacterSize(letterHeight);
    text->setFont(
        osgText::readRefFontFile("fonts/arial.ttf")); // osgViewer's own overlays'; OSG's default where it is not
    text->setAlignment(osgText::TextBase::LEFT_BOTTOM);
    text->setColor(osg::Vec4(1, 1, 1, 1));
    text->setDrawMode(osgText::Text::TEXT | osgText::Text::FILLEDBOUNDINGBOX);
    text->setBoundingBoxColor(osg::Vec4(0, 0, 0, 0.6f));
    text->setBoundingBoxMargin(margin / 2.0f);
    return text;
}

osg::ref_ptr<osg::Camera> makeCamera(osgText::Text& text) {
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setReferenceFrame(osg::Camera::ABSOLUTE_RF);
    camera->setRenderOrder(osg::Camera::POST_RENDER);
    camera->setClearMask(0);
    camera->setAllowEventFocus(false);
    camera->setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(&text);
    camera->addChild(geode);
    keepLegible(*camera->getOrCreateStateSet());
    return camera;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
    return text;
}

} // namespace

Hud::Hud(Lines lines) : _lines(std::move(lines)), _text(makeText()) { _camera = makeCamera(*_text); }

void Hud::toggle() { _camera->setNodeMask(_camera->getNodeMask() ? 0u : ~0u); }

void Hud::yieldTo(osg::Camera& help) {
    _help = &help;
    _help->setNodeMask(0u); // as osgViewer's handler sets it when the help is switched off
}

bool Hud::handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) {
    const auto* view = dynamic_cast<osgViewer::View*>(&action);
    if (event.getEventType() != osgGA::GUIEventAdapter::FRAME || !view) return false;
    _camera->getChild(0)->setNodeMask(_help && _help->getNodeMask() ? 0u : ~0u);
    write();
    if (const osg::Viewport* viewport = view->getCamera()->getViewport()) fit(viewport->width(), viewport->height());
    return false;
}

void Hud::fit(double width, double height) {
    _camera->setProjectionMatrixAsOrtho2D(0.0, width, 0.0, height);
    _text->setMaximumWidth(static_cast<float>(width) - 2.0f * margin);
    const osg::BoundingBox& box = _text->getBoundingBox(); // with its dark ground, half a margin wider
    if (box.valid())
        _text->setPosition(osg::Vec3d(_text->getPosition().x() + width - margin / 2.0f - box.xMax(), margin, 0.0));
}

void Hud::write() {
    const std::string text = joined(_lines());
    if (text == _written) return;
    _text->setText(text, osgText::String::ENCODING_UTF8);
    _written = text;
}

} // namespace gnomon::examples
