// SPDX-License-Identifier: MIT
#pragma once
#include "AddedLamp.h"

#include <gnomon/ShadowCasterGroup.h>

#include <deque>
#include <string>

namespace gnomon::examples {

/// Spotlights on some things, the sum of their passes, and the view from one of them.
class AddedLamps {
public:
    /// @param count  1 … AddedLamp::most.
    AddedLamps(osg::Node& things, int count);

    /// Lights that nothing but these may be added to: there is no ambient light beside theirs.
    osg::Group* node() { return _node; }
    AddedLamp& operator[](std::size_t i) { return _lamps[i]; }
    const AddedLamp& operator[](std::size_t i) const { return _lamps[i]; }

    /// Lets them be the lights of a group, too, whose shadows take away what passes leave out.
    void shineOn(ShadowCasterGroup& group);
    /// See DepthPass; all maps are drawn anew.
    void setMaps(bool fastCopy, bool displaced);
    /// "maps drawn: 1 1 4", how often each.
    std::string mapsDrawn() const;

    /// Draws the passes, or nothing but the lamps.
    void showPasses(bool on);
    void showBoxes(bool on) { _boxes->setNodeMask(on ? ~0u : 0u); }
    /// Of depth at look-up, -1 … 1 from near to far.
    void setBias(float bias) { _bias->set(bias); }
    void setBicubic(bool on) { _bicubic->set(on); }
    /// Sees the things as from a lamp, in its light alone, without shadows, which are what it does not see.
    /// @param aspect  width to height.
    void lookFrom(const osg::Matrixd& view, double aspect);
    void showView(bool on) { _view->setNodeMask(on ? ~0u : 0u); }

private:
    void setUpView(osg::Node& casters);

    osg::ref_ptr<osg::Group> _node = new osg::Group, _boxes = new osg::Group;
    osg::ref_ptr<osg::Camera> _view = new osg::Camera;
    osg::ref_ptr<osg::Uniform> _bias = new osg::Uniform("bias", 0.0f), _bicubic = new osg::Uniform("bicubic", false);
    std::deque<AddedLamp> _lamps;
};

} // namespace gnomon::examples
