// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/map/MapLayer.h>
#include <gnomon/map/OwnCasters.h>

#include <osg/Referenced>
#include <osg/State>
#include <osg/ref_ptr>

#include <vector>

namespace gnomon {

/// What casts below a group in one revision as maps draw it. Never changed once made.
struct MapCasters : public osg::Referenced {
    MapCasters(const CasterLayers& casters, osg::ref_ptr<const MapLayer> standing, osg::ref_ptr<const MapLayer> others)
        : layers(&casters), still(std::move(standing)), moving(std::move(others)), own(ownCastersOf(casters)) {}

    const osg::ref_ptr<const CasterLayers> layers;
    const osg::ref_ptr<const MapLayer> still, moving; ///< never null.
    const std::vector<OwnCaster> own;                 ///< drawn with what moves.

    void resizeGLObjectBuffers(unsigned maxSize) const {
        for (const auto& layer : {still, moving}) layer->resizeGLObjectBuffers(maxSize);
    }
    void releaseGLObjects(osg::State* state) const {
        for (const auto& layer : {still, moving}) layer->releaseGLObjects(state);
    }

protected:
    ~MapCasters() override = default;
};

} // namespace gnomon
