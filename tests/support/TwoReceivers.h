// SPDX-License-Identifier: MIT
#pragma once
#include <support/Oracle.h>
#include <support/Scene.h>

#include <osg/Light>
#include <osg/View>

#include <functional>
#include <string>
#include <vector>

namespace test {

/// A box above two receivers that lie side by side in z = 0, each a node with a state set of its own: what a test does
/// to one of them must not show on the other. Two screens lean before them, receive nothing, and hide part of either
/// receiver and of its shadow; one is drawn before the shadows and one after.
struct TwoReceivers : Scene {
    osg::ref_ptr<osg::Group> receivers;    ///< named "receivers"; holds `left` and `right`.
    osg::ref_ptr<osg::Group> casters;      ///< holds the box and the screens: marks are looked for no further.
    osg::ref_ptr<osg::Geode> left, right;  ///< x from -8 to 0 and from 0 to 8; corners every 2.
    osg::ref_ptr<osg::Geode> screen, late; ///< before `right`; before `left` in two parts, in bin 11.
    osg::ref_ptr<osg::LightSource> fill;   ///< shines from elsewhere, and casts no shadow.
    osg::Vec4d lightInWorld;               ///< where the light that casts is, for the rays.
    bool discovered = false;               ///< the group is told no light: it finds those that are on.
    osg::View::LightingMode mode = osg::View::NO_LIGHT;
    osg::ref_ptr<osg::Light> viewersLight; ///< for the other modes.

    osg::Light& caster() { return viewersLight ? *viewersLight : *light->getLight(); }
};

const View& viewOfTwoReceivers();

/// @param light  homogeneous, in the world.
TwoReceivers twoReceivers(const osg::Vec4d& light);

/// The viewer's own light, in eye space for HEADLIGHT, in the world for SKY_LIGHT; the graph then holds none.
void lightByViewer(TwoReceivers& scene, osg::View::LightingMode mode, const osg::Vec4& position);
/// The light and its mode become those of OpenGL light `number`; the other light gets the next number.
void renumber(TwoReceivers& scene, int number);
/// Only one light, which the group has to find.
void leaveToDiscovery(TwoReceivers& scene);
/// Puts the light that casts out, diffuse and specular, wherever the graph or the viewer holds it.
void putOut(TwoReceivers& scene);

enum class Receiving {
    Named,            ///< the short way of the compositor: nothing else can show on the receivers
    NamedAmongOthers, ///< something else might: its long way
    Unnamed           ///< everything opaque receives, but only what lies in the plane is marked
};
const char* nameOf(Receiving receiving);

/// What a case does to the scene, and what is to be expected of it.
struct ReceiverCase {
    std::string name;
    std::function<void(TwoReceivers&)> change = [](TwoReceivers&) {};
    bool lamp = false; ///< lit by a lamp above instead of a sun.
    /// False where an unnamed receiver does not stand at the plane's depth: it may then lose its shadow, and no more.
    bool exactUnnamed = true;
    /// What else the picture without the light needs; for receivers that cannot lose a light and take a factor of 0.
    std::function<void(TwoReceivers&)> alsoDark = [](TwoReceivers&) {};
    std::size_t causes = 0; ///< sentences that diagnose() is to give.
};
std::ostream& operator<<(std::ostream& out, const ReceiverCase& given);

/// What frames 1 to 3 show, at worst.
struct ReceiverVerdict {
    int wrongInside = 0; ///< away from edges not the colour that the rays choose: must be 0.
    int wrongAtEdge = 0; ///< at edges neither lit nor dark: must be 0.
    int wrongLit = 0;    ///< away from edges in the light, and changed: must be 0 even where shadows may be lost.
    int wrongAny = 0;    ///< anywhere neither lit nor dark: the same.
    int flipped = 0, edges = 0;
    std::vector<std::string> causes; ///< of the technique in the last frame.
};

/// The pictures that a case is measured by: lit and dark frames drawn without Gnomon, and the rays.
class ReceiverTruth {
public:
    /// @param angle  0 or 1: which of two places the light stands in.
    ReceiverTruth(const ReceiverCase& given, int angle);

    ReceiverVerdict judge(Receiving receiving) const;
    /// Pixels in shadow on a receiver, away from edges, where light and dark differ: without some a case shows nothing.
    int shadowOnLeft() const { return _onLeft; }
    int shadowOnRight() const { return _onRight; }

private:
    TwoReceivers build() const;

    ReceiverCase _given;
    osg::Vec4d _light;
    std::vector<Picture> _lit, _dark;
    Mask _mask;
    int _onLeft = 0, _onRight = 0;
};

/// Frames 1 to 3 of a scene, with the lighting mode that it asks for.
std::vector<Picture> threeFrames(const TwoReceivers& scene, const View& view);
/// Wraps the content in a group with a technique on z = 0.
osg::ref_ptr<gnomon::PlanarShadowNode> castOnReceivers(TwoReceivers& scene, Receiving receiving);

} // namespace test
