// SPDX-License-Identifier: MIT
#include "Hud.h"
#include "Legible.h"

#include <osg/Geode>
#include <osgViewer/View>

namespace gnomon::examples {
namespace {

constexpr float letterHeight = 16.0f, margin = 10.0f; // pixels

osg::ref_ptr<osgText::Text> makeText() {
    osg::ref_ptr<osgText::Text> text = new osgText::Text;
    text->setDataVariance(osg::Object::DYNAMIC);
    text->setCharacterSize(letterHeight);
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

bool Hud::handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) {
    const auto* view = dynamic_cast<osgViewer::View*>(&action);
    if (event.getEventType() != osgGA::GUIEventAdapter::FRAME || !view) return false;
    if (const osg::Viewport* viewport = view->getCamera()->getViewport()) fit(viewport->width(), viewport->height());
    write();
    return false;
}

void Hud::fit(double width, double height) {
    _camera->setProjectionMatrixAsOrtho2D(0.0, width, 0.0, height);
    _text->setPosition(osg::Vec3d(margin, margin, 0.0));
    _text->setMaximumWidth(static_cast<float>(width) - 2.0f * margin);
}

void Hud::write() {
    const std::string text = joined(_lines());
    if (text == _written) return;
    _text->setText(text, osgText::String::ENCODING_UTF8);
    _written = text;
}

} // namespace gnomon::examples
