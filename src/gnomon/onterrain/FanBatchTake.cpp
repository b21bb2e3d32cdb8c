// SPDX-License-Identifier: MIT
// FanBatch: from parts to blocks of those whose silhouettes have the same corners.
#include <gnomon/geometry/ReusedBuffer.h>
#include <gnomon/onterrain/FanBatch.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gnomon {
namespace {

template <class Number>
void makeRoom(std::vector<Number>& numbers, std::size_t count) {
    if (numbers.size() < count + kernelPad) numbers.resize(count + kernelPad);
}

} // namespace

void FanBatch::take(const PackedParts& parts, std::size_t first, std::size_t end) {
    _entries.assign(end - first, {});
    _fans.clear();
    _members.clear();
    _edgeCount = _faceCount = 0;
    _taken.assign(end - first, 0);
    for (std::size_t i = 0; i < size(); ++i) {
        if (_taken[i]) continue;
        _kind.clear();
        for (std::size_t k = i; k < size(); ++k) {
            if (&parts.topology(first + k) != &parts.topology(first + i)) continue;
            _kind.push_back(k);
            _taken[k] = 1;
        }
        takeKind(parts, first);
    }
    _kernel->edges(kernelFans(0, _fans.size()));
    for (Entry& entry : _entries) entry.tangent = entry.fan == none || _light.w == 0.0 ? _tangent : leastTangent(entry);
}

/// Parts of one topology, side by side.
void FanBatch::takeKind(const PackedParts& parts, std::size_t first) {
    const HullTopology& topology = parts.topology(first + _kind.front());
    askFaces(parts, first);
    _left.resize(_kind.size());
    std::iota(_left.begin(), _left.end(), std::size_t(0));
    while (!_left.empty()) {
        _alike.clear();
        const std::size_t one = _left.front();
        std::size_t kept = 0;
        for (const std::size_t i : _left)
            if (isAlike(i, one))
                _alike.push_back(i);
            else
                _left[kept++] = i;
        _left.resize(kept);
        takeAlike(topology);
    }
}

bool FanBatch::isAlike(std::size_t a, std::size_t b) const {
    for (std::size_t word = 0; word < _hulls.faces / 64 + 1; ++word)
        if (litOf(a, word) != litOf(b, word)) return false;
    return true;
}

void FanBatch::askFaces(const PackedParts& parts, std::size_t first) {
    const HullTopology& topology = parts.topology(first + _kind.front());
    const std::size_t faces = topology.faces.size(), blocks = (_kind.size() + kernelLanes - 1) / kernelLanes;
    makeRoom(_places, 3 * topology.corners * blocks * kernelLanes);
    makeRoom(_lights, 3 * blocks * kernelLanes);
    makeRoom(_sizes, blocks * kernelLanes);
    makeRoom(_facePlanes, 4 * faces * blocks * kernelLanes);
    makeRoom(_lit, (faces / 64 + 1) * blocks * kernelLanes);
    _hulls = {blocks,   topology.corners, faces,    _places.data(),     topology.faces.data(), _lights.data(), _light.x,
              _light.y, _light.z,         _light.w, _facePlanes.data(), _lit.data(),           _sizes.data()};
    for (std::size_t block = 0; block < blocks; ++block) packBlock(parts, first, block);
    _kernel->face(_hulls);
    if (!_isLight) std::fill(_lit.begin(), _lit.end(), std::uint64_t(0));
    for (std::size_t i = 0; i < _kind.size(); ++i) {
        Entry& entry = _entries[_kind[i]];
        entry.anchor = parts.anchor(first + _kind[i]);
        entry.light = glm::dvec4(glm::dvec3(_light) - _light.w * entry.anchor, _light.w);
        entry.size = _sizes[i];
    }
}

/// Eight parts as the kernel reads them, some of them twice where there are fewer.
void FanBatch::packBlock(const PackedParts& parts, std::size_t first, std::size_t block) {
    std::array<const float*, kernelLanes> from;
    for (std::size_t lane = 0; lane < kernelLanes; ++lane) {
        const std::size_t part = first + _kind[std::min(block * kernelLanes + lane, _kind.size() - 1)];
        from[lane] = &parts.others(part)->x;
        double* light = _lights.data() + 3 * block * kernelLanes + lane;
        for (int k = 0; k < 3 && _light.w != 0.0; ++k, light += kernelLanes)
            *light = _light[k] - _light.w * parts.anchor(part)[k];
    }
    _kernel->pack(from, 3 * (_hulls.corners - 1), _places.data() + 3 * _hulls.corners * block * kernelLanes);
}

/// Parts of which the light meets the same faces.
void FanBatch::takeAlike(const HullTopology& topology) {
    _isLit.assign(topology.faces.size() + 1, 0);
    _litFaces.clear();
    for (unsigned f = 0; f < topology.faces.size(); ++f) {
        if (!(litOf(_alike.front(), f / 64) >> (f % 64) & 1u)) continue;
        _isLit[f] = 1;
        _litFaces.push_back(f);
    }
    findSilhouette(topology);
    const bool isThere = !_litFaces.empty() && !_loop.empty();
    const bool isInside = _light.w > 0.0 && !topology.isPlate();
    const bool isTurned = topology.front >= 0 && !_isLit[std::size_t(topology.front)];
    const TerrainOutcome outcome = isTurned   ? TerrainOutcome::turnedAway
                                   : isThere  ? TerrainOutcome::fan
                                   : isInside ? TerrainOutcome::lightInside
                                              : TerrainOutcome::edgeOn;
    for (std::size_t i = 0; i < _alike.size(); ++i) {
        Entry& entry = _entries[_kind[_alike[i]]];
        entry.outcome = outcome;
        entry.fan = isThere ? _fans.size() + i / kernelLanes : none;
        entry.lane = i % kernelLanes;
    }
    if (isThere) addFans();
}

void FanBatch::findSilhouette(const HullTopology& topology) {
    if (!topology.isTabled()) {
        topology.silhouette(_isLit.data(), _loop);
        return;
    }
    const HullTopology::Loop loop = topology.silhouette(unsigned(litOf(_alike.front(), 0)));
    _loop.assign(loop.begin, loop.end);
}

/// A block for each eight. Lanes without a part have another's numbers.
void FanBatch::addFans() {
    const std::size_t count = _alike.size(), edges = _loop.size();
    _alike.resize((count + kernelLanes - 1) / kernelLanes * kernelLanes, _alike.front());
    for (std::size_t first = 0; first < count; first += kernelLanes) {
        KernelFan fan{};
        fan.parts = std::min(count - first, kernelLanes);
        fan.edges = edges;
        fan.faces = _litFaces.size();
        fan.edge = grow(_edges, _edgeCount, edges);
        fan.face = grow(_faces, _faceCount, fan.faces);
        _fans.push_back(fan);
        if (_parts.size() < _fans.size()) _parts.resize(2 * _fans.size());
        KernelChoice choice{{}, _loop.data(), _litFaces.data()};
        std::copy_n(_alike.begin() + std::ptrdiff_t(first), kernelLanes, choice.parts.begin());
        _kernel->choose(_hulls, choice, kernelFans(0, _fans.size()), _fans.size() - 1);
        addParts(_alike.data() + first);
    }
}

void FanBatch::addParts(const std::size_t* lanes) {
    KernelPart& part = _parts[_fans.size() - 1];
    for (std::size_t lane = 0; lane < kernelLanes; ++lane) {
        const std::size_t i = _kind[lanes[lane]];
        const Entry& entry = _entries[i];
        _members.push_back(i);
        part.u[lane] = (entry.anchor.x - _origin.x) * _scale.x;
        part.v[lane] = (entry.anchor.y - _origin.y) * _scale.y;
        part.z[lane] = entry.anchor.z - _base;
        part.margin[lane] = inGround * entry.size;
        if (_light.w == 0.0) continue;
        part.lightX[lane] = entry.light.x;
        part.lightY[lane] = entry.light.y;
        part.lightZ[lane] = entry.light.z;
    }
}

} // namespace gnomon
