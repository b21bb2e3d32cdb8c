// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/traced/TracedFrames.h>

#include <OpenThreads/ScopedLock>

#include <tuple>
#include <unordered_set>
#include <utility>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

constexpr std::size_t mostBoxes = 16; // of what has changed: a look at more costs as much as a ray

/// True if depths of both mean the same places, of the same pixels.
bool isSamePart(const DepthPicture& a, const DepthPicture& b) {
    const auto key = [](const DepthPicture& p) {
        return std::make_tuple(p.viewportWidth, p.viewportHeight, p.x, p.y, p.width, p.height, p.step, p.subpixel,
                               p.place.x, p.place.y, p.offPlace, p.drawnPixels, p.drawnDepth);
    };
    return key(a) == key(b);
}

} // namespace

std::shared_ptr<const TracedFrames::Pieces> TracedFrames::piecesOf(const CasterDrawables* casters) {
    if (!casters) return nullptr;
    auto pieces = std::make_shared<Pieces>();
    pieces->reserve(casters->list.size());
    for (const auto& piece : casters->list) pieces->push_back({piece->fingerprint, piece->bounds});
    return pieces;
}

/// Adds the boxes of those that others lack. @return false if there are too many.
bool TracedFrames::addMissing(const Pieces& pieces, const Pieces& others, const osg::Vec3d& origin,
                              std::vector<RayBox>& boxes) {
    std::unordered_set<std::uint64_t> known;
    for (const Piece& piece : others) known.insert(piece.fingerprint);
    for (const Piece& piece : pieces) {
        if (known.count(piece.fingerprint) > 0 || !piece.bounds.valid()) continue;
        if (boxes.size() == mostBoxes) return false;
        boxes.push_back({toGlm(piece.bounds._min - origin), toGlm(piece.bounds._max - origin)});
    }
    return true;
}

/// Where what casts differs; nullopt if that may be anywhere.
std::optional<std::vector<RayBox>> TracedFrames::changesBetween(const Known& before, const Pieces* now,
                                                                const osg::Vec3d& origin) {
    std::vector<RayBox> boxes;
    const bool comparable = before.pieces && now && before.frame.origin == origin;
    if (!comparable || !addMissing(*before.pieces, *now, origin, boxes) ||
        !addMissing(*now, *before.pieces, origin, boxes))
        return std::nullopt;
    return boxes;
}

std::shared_ptr<const TracedFrames::Known> TracedFrames::find(const TracedFrame& frame) {
    Lock lock(_mutex);
    const auto* found = _known.find(
        [&](const auto& known) { return known->frame.stage == frame.stage && known->frame.light == frame.light; });
    return found ? *found : nullptr;
}

void TracedFrames::keep(std::shared_ptr<const Known> known) {
    Lock lock(_mutex);
    _known.dropIf([&](const auto& old) {
        return old->frame.stage == known->frame.stage && old->frame.light == known->frame.light;
    });
    _known.dropOldestBeyond(most - 1);
    _known.add(std::move(known));
}

std::vector<std::uint8_t> TracedFrames::bitsOf(TracedFrame frame) {
    const std::shared_ptr<const Known> before = find(frame);
    const bool sameScene = before && before->scene.lock() == frame.scene;
    const auto pieces = sameScene ? before->pieces : piecesOf(frame.pieces.get());
    frame.pieces = nullptr;
    std::optional<std::vector<RayBox>> changed;
    if (before && before->frame.clipFromScene == frame.clipFromScene &&
        before->frame.lightInScene == frame.lightInScene && isSamePart(before->frame.picture, frame.picture))
        changed = sameScene ? std::vector<RayBox>() : changesBetween(*before, pieces.get(), frame.origin);
    std::optional<FormerShadow> former;
    if (changed) former.emplace(FormerShadow{before->frame.picture, before->bits, std::move(*changed)});
    const std::shared_ptr<const RayScene> scene = std::move(frame.scene);
    TracedBits found =
        depthBufferShadow(*scene, frame.picture, frame.clipFromScene, frame.lightInScene, former ? &*former : nullptr);
    _traced += found.traced;
    keep(std::make_shared<const Known>(Known{std::move(frame), scene, pieces, found.bits}));
    return std::move(found.bits);
}

} // namespace gnomon
