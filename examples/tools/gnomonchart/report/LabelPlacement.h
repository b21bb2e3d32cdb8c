// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec2.hpp>

#include <vector>

namespace gnomon::examples {

/// A rectangle on the page, px.
struct PageBox {
    glm::dvec2 low{0.0}, high{0.0};

    bool overlaps(const PageBox& other) const;
    bool holds(const PageBox& other) const;
};

/// A point of what is drawn, and whose.
struct DrawnPoint {
    glm::dvec2 at;
    std::size_t owner;
};

/// A text that wants a place.
struct LabelWish {
    glm::dvec2 size;                 ///< px, of the text.
    std::vector<glm::dvec2> anchors; ///< what it may stand at, the dearest first.
    std::size_t owner = 0;           ///< whose text it is.
    bool mustStand = true;           ///< false: rather left out than in the way of anything.
};

struct PlacedLabel {
    bool placed = false;
    PageBox box;
    glm::dvec2 anchor{0.0}; ///< which it stands at.
    bool leader = false;    ///< too far from it to be understood without a line there.
};

/// Finds each text a place near one of its anchors where it covers as little as can be: no other text, no marker, and
/// if there is room no line; and where nothing of another owner is nearer than its anchor. Greedy: the first wish is
/// served first.
///
/// @param frame    where texts may be.
/// @param markers  boxes of what must not be covered.
/// @param lines    points along curves, a few px apart, that had better not be.
std::vector<PlacedLabel> placeLabels(const std::vector<LabelWish>& wishes, const PageBox& frame,
                                     const std::vector<PageBox>& markers, const std::vector<DrawnPoint>& lines);

} // namespace gnomon::examples
