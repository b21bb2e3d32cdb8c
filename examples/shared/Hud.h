// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Camera>
#include <osgGA/GUIEventHandler>
#include <osgText/Text>

#include <functional>
#include <string>
#include <vector>

namespace gnomon::examples {

/// Keeps text what it is where osgviewer's keys turn the scene into a wire frame, or take its lights or textures away.
void keepLegible(osg::StateSet& set);

/// Puts a dark veil before all that is drawn so far and behind what `camera`, of osgViewer's help, draws.
void darkenBehind(osg::Camera& camera);

/// Lines of text in the window's lower right corner, where no map's picture is, asked for anew each frame.
class Hud : public osgGA::GUIEventHandler {
public:
    using Lines = std::function<std::vector<std::string>()>;
    explicit Hud(Lines lines);

    /// To be put into the scene, under no transform.
    osg::Camera* camera() { return _camera; }
    /// Hides or shows it.
    void toggle();
    /// Hides it while this camera of osgViewer's help, which is off now, draws.
    void yieldTo(osg::Camera& help);

    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;

private:
    void fit(double width, double height);
    void write();

    Lines _lines;
    osg::ref_ptr<osg::Camera> _camera, _help;
    osg::ref_ptr<osgText::Text> _text;
    std::string _written;
};

} // namespace gnomon::examples
