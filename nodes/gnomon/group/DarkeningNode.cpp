// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/casters/DrawableTriangles.h>
#include <gnomon/group/DarkeningNode.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace gnomon {
namespace {

constexpr std::size_t mostLeaves = 24, mostCasters = 4, mostTriangles = 20000, mostRays = 64, fewestRays = 12;
constexpr double nearlyAll = 0.95; // of the rays

/// A place that is seen, and the way from there to the light.
struct Sample {
    const osg::Drawable* drawable;
    glm::dvec3 place, along;
    double reach; ///< in lengths of the way.
};

Sample sampleAt(const osg::Drawable* drawable, const osg::Vec3d& place, const osg::Vec4d& light) {
    const glm::dvec3 from = toGlm(place), at(light.x(), light.y(), light.z());
    if (light.w() == 0.0) return {drawable, from, at, std::numeric_limits<double>::infinity()};
    return {drawable, from, at / light.w() - from, 1.0};
}

bool isInView(const osg::Vec3d& inEye, const osg::Matrixd& projection) {
    const osg::Vec4d clip = osg::Vec4d(inEye, 1.0) * projection;
    return clip.w() > 0.0 && std::abs(clip.x()) <= clip.w() && std::abs(clip.y()) <= clip.w();
}

void addSamples(const osgUtil::RenderLeaf& leaf, const ViewFrame& view, const osg::Matrixd& groupFromEye,
                const osg::Vec4d& light, std::vector<Sample>& samples) {
    const osg::BoundingBox& box = leaf._drawable->getBoundingBox();
    if (!box.valid()) return;
    for (int i = 0; i < 27; ++i) {
        const osg::Vec3d share((1 + 2 * (i % 3)) / 6.0, (1 + 2 * (i / 3 % 3)) / 6.0, (1 + 2 * (i / 9)) / 6.0);
        const osg::Vec3d size = box._max - box._min;
        const osg::Vec3d inEye = (osg::Vec3d(box._min) + osg::componentMultiply(share, size)) * *leaf._modelview;
        if (isInView(inEye, view.projection))
            samples.push_back(sampleAt(leaf._drawable.get(), inEye * groupFromEye, light));
    }
}

std::vector<Sample> samplesOf(const ViewFrame& view, const osg::Vec4d& light) {
    std::vector<Sample> samples;
    const osg::Matrixd groupFromEye = osg::Matrixd::inverse(view.eyeFromGroup);
    const std::size_t every = view.seen.size() / mostLeaves + 1;
    for (std::size_t i = 0; i < view.seen.size(); i += every)
        addSamples(*view.seen[i], view, groupFromEye, light, samples);
    return samples;
}

bool meets(const osg::BoundingBoxd& box, const Sample& ray) {
    double from = 0.0, to = ray.reach;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = (box._min[axis] - ray.place[axis]) / ray.along[axis],
                     high = (box._max[axis] - ray.place[axis]) / ray.along[axis];
        from = std::max(from, std::min(low, high));
        to = std::min(to, std::max(low, high));
    }
    return from <= to;
}

/// Counts the rays that a drawable's triangles block.
class BlockedRays : public TriangleDecoder {
public:
    BlockedRays(const CasterDrawable& caster, std::vector<Sample> free)
        : TriangleDecoder(caster.groupFromLocal, caster.quads), _free(std::move(free)) {}
    ~BlockedRays() override = default;
    std::size_t free() const { return _free.size(); }

protected:
    void start(unsigned) override {}
    void point(unsigned) override {}
    void triangle(unsigned a, unsigned b, unsigned c) override {
        if (!isInArray(a) || !isInArray(b) || !isInArray(c)) return;
        const glm::dvec3 corner = place(a), u = place(b) - corner, v = place(c) - corner;
        const auto isBlocked = [&](const Sample& ray) { return blocks(corner, u, v, ray); };
        _free.erase(std::remove_if(_free.begin(), _free.end(), isBlocked), _free.end());
    }

private:
    glm::dvec3 place(unsigned index) const { return toGlm(inRoot(local(index))); }
    /// Möller and Trumbore 1997.
    static bool blocks(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, const Sample& ray) {
        const glm::dvec3 p = glm::cross(ray.along, v), s = ray.place - corner, q = glm::cross(s, u);
        const double determinant = glm::dot(u, p);
        const double x = glm::dot(s, p) / determinant, y = glm::dot(ray.along, q) / determinant,
                     t = glm::dot(v, q) / determinant;
        return x >= 0.0 && y >= 0.0 && x + y <= 1.0 && t > 0.0 && t < ray.reach;
    }

    std::vector<Sample> _free;
};

/// The samples that are not of the caster itself, no more than are cast.
std::vector<Sample> othersThan(const CasterDrawable& caster, const std::vector<Sample>& samples) {
    std::vector<Sample> others;
    for (const Sample& sample : samples)
        if (sample.drawable != caster.drawable) others.push_back(sample);
    const std::size_t every = others.size() / mostRays + 1;
    std::vector<Sample> some;
    for (std::size_t i = 0; i < others.size(); i += every) some.push_back(others[i]);
    return some;
}

bool darkensAll(const CasterDrawable& caster, const std::vector<Sample>& samples) {
    const std::vector<Sample> others = othersThan(caster, samples);
    const auto most = static_cast<std::size_t>((1.0 - nearlyAll) * double(others.size()));
    const auto misses =
        std::count_if(others.begin(), others.end(), [&](const Sample& ray) { return !meets(caster.bounds, ray); });
    if (others.size() < fewestRays || std::size_t(misses) > most) return false;
    BlockedRays rays(caster, others);
    readTriangles(*caster.drawable, rays);
    return rays.free() <= most;
}

std::string nameOf(const osg::Node& node) {
    for (const osg::Node* above = &node; above; above = above->getNumParents() ? above->getParent(0) : nullptr)
        if (!above->getName().empty()) return above->getName();
    return node.className();
}

} // namespace

std::string whatDarkensAll(const CasterDrawables& casters, const ViewFrame& view, const ShadowLight& light) {
    CasterDrawables::List largest;
    for (const auto& piece : casters.list)
        if (piece->bounds.valid() && piece->triangles <= mostTriangles) largest.push_back(piece);
    const std::size_t count = std::min(mostCasters, largest.size());
    std::partial_sort(largest.begin(), largest.begin() + std::ptrdiff_t(count), largest.end(),
                      [](const auto& a, const auto& b) { return a->bounds.radius2() > b->bounds.radius2(); });
    largest.resize(count);
    const std::vector<Sample> samples = samplesOf(view, light.inGroup);
    for (const auto& piece : largest)
        if (darkensAll(*piece, samples))
            return "nearly all in this view lies in the shadow of '" + nameOf(*piece->drawable) +
                   "'. If it is a sky or the like, leave it out of setCasters(), or draw it at the far plane.";
    return "";
}

} // namespace gnomon
