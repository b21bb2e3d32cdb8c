// SPDX-License-Identifier: MIT
#include "LabelPlacement.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace gnomon::examples {
namespace {

constexpr std::array distances = {7.0, 12.0, 20.0, 32.0, 48.0, 68.0, 92.0, 120.0}; // px from the anchor to the text
constexpr int directions = 16;
constexpr double withoutLeader = 10.0; // px

// What a place costs, in px of distance that one would walk to be rid of it.
constexpr double overText = 400.0, overMarker = 60.0, overLine = 6.0, besideOthers = 12.0, lessDear = 6.0;

struct Trial {
    PlacedLabel label;
    double cost = std::numeric_limits<double>::infinity();
    bool free = false; ///< covers nothing.
};

class Placer {
public:
    Placer(const PageBox& frame, const std::vector<PageBox>& markers, const std::vector<DrawnPoint>& lines)
        : _frame(frame), _markers(markers), _lines(lines) {}

    PlacedLabel place(const LabelWish& wish) {
        Trial best;
        for (std::size_t i = 0; i < wish.anchors.size(); ++i)
            for (const double distance : distances)
                for (int k = 0; k < directions; ++k) keepBetter(best, trial(wish, i, distance, k));
        if (!best.label.placed || (!wish.mustStand && (!best.free || best.label.leader))) return {};
        _texts.push_back(best.label.box);
        return best.label;
    }

private:
    static void keepBetter(Trial& best, const Trial& other) {
        if (other.cost < best.cost) best = other;
    }

    /// The text beside an anchor: its nearest edge `distance` away.
    static PageBox beside(const glm::dvec2& anchor, const glm::dvec2& size, double distance, int direction) {
        const double angle = glm::radians(360.0 / directions * direction);
        const glm::dvec2 way(glm::cos(angle), glm::sin(angle));
        const glm::dvec2 centre = anchor + way * distance + 0.5 * size * glm::clamp(1.5 * way, -1.0, 1.0);
        return {centre - 0.5 * size, centre + 0.5 * size};
    }

    Trial trial(const LabelWish& wish, std::size_t anchor, double distance, int direction) const {
        Trial result;
        result.label = {true, beside(wish.anchors[anchor], wish.size, distance, direction), wish.anchors[anchor],
                        distance > withoutLeader};
        if (!_frame.holds(result.label.box)) return {};
        const double covered = covering(result.label);
        result.free = covered == 0.0;
        result.cost = covered + mistakable(result.label, wish.owner) + distance +
                      lessDear * static_cast<double>(anchor) + (direction % 4 ? 1.0 : 0.0);
        return result;
    }

    double covering(const PlacedLabel& label) const {
        const auto count = [&](const std::vector<PageBox>& boxes) {
            return static_cast<double>(
                std::count_if(boxes.begin(), boxes.end(), [&](const PageBox& b) { return b.overlaps(label.box); }));
        };
        const auto inside = [&](const DrawnPoint& p) { return label.box.holds({p.at, p.at}); };
        const auto onLine = static_cast<double>(std::count_if(_lines.begin(), _lines.end(), inside));
        return overText * count(_texts) + overMarker * count(_markers) + overLine * onLine + leaderCost(label);
    }

    /// Whether a reader may take it for another's.
    double mistakable(const PlacedLabel& label, std::size_t owner) const {
        const auto away = [&](const glm::dvec2& p) {
            return glm::distance(p, glm::clamp(p, label.box.low, label.box.high));
        };
        const double own = away(label.anchor);
        const auto nearer = [&](const DrawnPoint& p) { return p.owner != owner && away(p.at) < own; };
        return std::any_of(_lines.begin(), _lines.end(), nearer) ? besideOthers : 0.0;
    }

    /// A leader must not cross texts.
    double leaderCost(const PlacedLabel& label) const {
        if (!label.leader) return 0.0;
        const glm::dvec2 end = glm::clamp(label.anchor, label.box.low, label.box.high);
        double cost = 0.0;
        for (double t = 0.1; t < 1.0; t += 0.1) {
            const glm::dvec2 p = label.anchor + t * (end - label.anchor);
            for (const PageBox& text : _texts)
                if (text.holds({p, p})) cost += 0.2 * overText;
        }
        return cost;
    }

    const PageBox& _frame;
    const std::vector<PageBox>& _markers;
    const std::vector<DrawnPoint>& _lines;
    std::vector<PageBox> _texts;
};

} // namespace

bool PageBox::overlaps(const PageBox& o) const {
    return low.x < o.high.x && o.low.x < high.x && low.y < o.high.y && o.low.y < high.y;
}

bool PageBox::holds(const PageBox& o) const {
    return low.x <= o.low.x && low.y <= o.low.y && o.high.x <= high.x && o.high.y <= high.y;
}

std::vector<PlacedLabel> placeLabels(const std::vector<LabelWish>& wishes, const PageBox& frame,
                                     const std::vector<PageBox>& markers, const std::vector<DrawnPoint>& lines) {
    Placer placer(frame, markers, lines);
    std::vector<PlacedLabel> labels;
    for (const LabelWish& wish : wishes) labels.push_back(placer.place(wish));
    return labels;
}

} // namespace gnomon::examples
