// SPDX-License-Identifier: MIT
#pragma once
#include <osg/State>
#include <osg/VertexArrayState>

namespace gnomon {

/// Makes osg::State dispatch the next drawable's arrays whatever it has dispatched before. It knows arrays by their
/// addresses, and takes a new one at the address of a deleted one for that. Call it before and after drawables of the
/// kit, whose arrays come and go with techniques.
inline void forgetArrays(osg::State& state) {
    const unsigned unit = state.getClientActiveTextureUnit();
    state.bindVertexArrayObject(state.getCurrentVertexArrayState()); // whose arrays they are
    state.disableAllVertexArrays();                                  // goes through all units
    state.setClientActiveTextureUnit(unit);
}

} // namespace gnomon
