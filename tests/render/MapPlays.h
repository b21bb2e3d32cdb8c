// SPDX-License-Identifier: MIT
#pragma once
#include "TracedCases.h"

#include <gnomon/ShadowMapTechnique.h>
#include <osg/MatrixTransform>

#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

/// Scenes in which casters of maps move.
namespace test::layers {

using gnomon::ShadowMapTechnique;

/// Where each thing that moves is; nullopt where it is not in the scene.
using Moment = std::vector<std::optional<osg::Vec3d>>;

/// What stands still, what moves, and how it is lit.
struct Play {
    std::string name;
    TracedCase given;
    std::vector<osg::ref_ptr<osg::Node>> movers;
    std::function<void(ShadowMapTechnique&)> change{}; ///< may be none, as the next.
    std::function<void(Scene&)> light{};
    bool first = false; ///< what moves comes before what stands still.
};

struct Stage {
    explicit Stage(const Play& play) : scene(play.given.build()), first(play.first) {
        for (const auto& mover : play.movers) {
            places.push_back(new osg::MatrixTransform);
            places.back()->addChild(mover);
        }
        technique->setSize(512);
        if (play.change) play.change(*technique);
        scene.addShadow(technique);
        if (play.light) play.light(scene);
    }

    void set(const Moment& moment) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            scene.content->removeChild(places[i]);
            if (!moment[i]) continue;
            places[i]->setMatrix(osg::Matrixd::translate(*moment[i]));
            scene.content->insertChild(first ? 0 : scene.content->getNumChildren(), places[i]);
        }
    }

    Scene scene;
    std::vector<osg::ref_ptr<osg::MatrixTransform>> places;
    osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
    bool first;
};

/// By maps that never saw another moment, in a context of its own.
Picture freshPicture(const Play& play, const Moment& moment, const View& from);

/// The same, all in one context, which is sooner done.
class FreshPictures {
public:
    explicit FreshPictures(const View& from) : _camera(new osg::Group, from) {}

    Picture of(const Play& play, const Moment& moment) {
        Stage stage(play);
        stage.set(moment);
        _camera.viewer().setSceneData(stage.scene.root);
        const Picture picture = _camera.frame();
        _camera.viewer().setSceneData(new osg::Group);
        return picture;
    }

private:
    Camera _camera;
};

inline const View view = test::perspective({-9.0, -13.0, 11.0}, {0.0, 0.0, 0.0}, 320, 240);

TracedCase inSun();
/// The same about a lamp: a carpet under all, and in each of its maps something nearer to it than what moves.
TracedCase byLamp();

osg::ref_ptr<osg::Node> aBox();
osg::ref_ptr<osg::Node> aBall();
osg::ref_ptr<osg::Node> aBoard();
/// A chequered pane: of every second square there is nothing.
osg::ref_ptr<osg::Node> aFence();

/// One stands at first and moves, stops, goes and comes back; another comes later, before it or behind it.
inline const std::vector<Moment> toAndFro{
    {osg::Vec3d(-3.0, -3.0, 0.0), std::nullopt},
    {osg::Vec3d(-3.0, -3.0, 0.0), std::nullopt},
    {osg::Vec3d(-2.0, -2.5, 0.2), std::nullopt},
    {osg::Vec3d(-0.7, -2.0, 0.4), osg::Vec3d(3.0, -2.0, 0.0)},
    {osg::Vec3d(-0.7, -2.0, 0.4), osg::Vec3d(3.0, -1.0, 0.0)},
    {osg::Vec3d(-0.7, -2.0, 0.4), osg::Vec3d(3.0, -1.0, 0.0)},
    {std::nullopt, osg::Vec3d(1.5, 0.0, 0.5)},
    {std::nullopt, std::nullopt},
    {osg::Vec3d(2.0, -3.0, 0.0), osg::Vec3d(1.0, 0.2, 0.5)},
    {osg::Vec3d(2.2, -3.0, 0.0), std::nullopt},
};

/// Each kind of light, edges, composite and mover.
std::vector<Play> plays();
void PrintTo(const Play& play, std::ostream* out);

} // namespace test::layers
