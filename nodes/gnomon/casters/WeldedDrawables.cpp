// SPDX-License-Identifier: MIT
#include <gnomon/base/Fingerprint.h>
#include <gnomon/casters/CasterExtraction.h>
#include <gnomon/casters/WeldedDrawables.h>

#include <algorithm>
#include <numeric>

namespace gnomon {
namespace {

osg::BoundingBoxd common(const osg::BoundingBoxd& a, const osg::BoundingBoxd& b) { return a.intersect(b); }

/// Of each piece the bounds of what it has in common with others' bounds; invalid if that is nothing.
std::vector<osg::BoundingBoxd> seamsOf(const CasterDrawables::List& pieces) {
    std::vector<std::size_t> order(pieces.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return pieces[a]->bounds.xMin() < pieces[b]->bounds.xMin(); });
    std::vector<osg::BoundingBoxd> seams(pieces.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const osg::BoundingBoxd& box = pieces[order[i]]->bounds;
        for (std::size_t k = i + 1; k < order.size() && pieces[order[k]]->bounds.xMin() <= box.xMax(); ++k) {
            const osg::BoundingBoxd& other = pieces[order[k]]->bounds;
            if (!touch(box, other)) continue;
            seams[order[i]].expandBy(common(box, other));
            seams[order[k]].expandBy(common(box, other));
        }
    }
    return seams;
}

/// A vertex's place, and whose it is.
struct Corner {
    std::uint64_t place;
    std::size_t piece;
    bool operator<(const Corner& other) const { return place < other.place; }
};

void addCorners(const CasterDrawable& piece, const osg::BoundingBoxd& within, std::size_t index,
                std::vector<Corner>& corners) {
    CasterExtraction read;
    read.setRootFromVisited(piece.groupFromLocal);
    if (!piece.kept) const_cast<osg::Drawable&>(*piece.drawable).accept(read); // which changes nothing
    for (const osg::Vec3d& vertex : (piece.kept ? *piece.kept : read).getVertices()) {
        if (!within.contains(vertex)) continue;
        Fingerprint place;
        for (int i = 0; i < 3; ++i) place.mix(vertex[i] + 0.0); // -0 and 0 are one place
        corners.push_back({place.value(), index});
    }
}

std::size_t rootOf(std::vector<std::size_t>& above, std::size_t piece) {
    while (above[piece] != piece) piece = above[piece] = above[above[piece]];
    return piece;
}

} // namespace

std::vector<std::size_t> weldedDrawables(const CasterDrawables::List& pieces) {
    const std::vector<osg::BoundingBoxd> seams = seamsOf(pieces);
    std::vector<Corner> corners;
    for (std::size_t i = 0; i < pieces.size(); ++i)
        if (seams[i].valid()) addCorners(*pieces[i], seams[i], i, corners);
    std::sort(corners.begin(), corners.end());
    std::vector<std::size_t> above(pieces.size());
    std::iota(above.begin(), above.end(), std::size_t{0});
    for (std::size_t i = 1; i < corners.size(); ++i) {
        if (corners[i].place != corners[i - 1].place) continue;
        const std::size_t a = rootOf(above, corners[i - 1].piece), b = rootOf(above, corners[i].piece);
        above[std::max(a, b)] = std::min(a, b);
    }
    for (std::size_t i = 0; i < above.size(); ++i) above[i] = rootOf(above, i);
    return above;
}

} // namespace gnomon
