// SPDX-License-Identifier: MIT
#pragma once
#include "Peers.h"
#include "Staging.h"

namespace gnomon::examples {

/// A scene under one of osgShadow's techniques.
///
/// Casting off  a cull callback keeps the content out of every camera that draws a shadow map, in Look::VISIBILITY only.
///              Bounds are asked of all of it as before, so that maps lie where they lay. (An empty cast mask would do
///              more: ViewDependentShadowMap's crop degenerates.)
/// ParallelSplit  is given the light by setUserLight(), as its documentation asks: it reads no position. A lamp's light
///              comes from the lamp through the scene's centre.
/// ShadowTexture  needs receivers that do not cast: what ChartScene::receiver names receives, all else casts.
class PeerStaging : public Staging {
public:
    /// @throws std::invalid_argument, one sentence, if the scene does not suit the peer or a setting is unknown.
    PeerStaging(const Peer& peer, const Settings& settings, const ChartScene& scene, Look look);
    ~PeerStaging() override;
    void setCasting(bool casts) override;

private:
    class Gate;

    osg::ref_ptr<Gate> _gate;
};

} // namespace gnomon::examples
