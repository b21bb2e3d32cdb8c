// SPDX-License-Identifier: MIT
#include "SceneSetup.h"

#include <gnomon/NamedNode.h>
#include <gnomon/VertexTraverser.h>

#include <osg/MatrixTransform>
#include <osgUtil/LineSegmentIntersector>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace gnomon::examples {
namespace {

constexpr double framingMargin = 1.15;    // of the scene's radius
constexpr double framingElevation = 30.0; // degrees
constexpr double fittingMargin = 1.05;
constexpr double floorHeight = 0.005; // of the scene's radius
constexpr double floorDepth = 0.06;   // the same: a slab, or what dips into the floor
constexpr double framedRadii = 4.0;   // of the scene: side of the square within which shadows are to be in the picture
constexpr double widestPart = 2.0;    // of the radius of what stands on it: such a floor is a part of the model
constexpr int raysASide = 6;

osg::ref_ptr<osg::Node> upright(osg::Node& files, bool yUp) {
    if (!yUp) return &files;
    osg::ref_ptr<osg::MatrixTransform> turn = new osg::MatrixTransform(
        osg::Matrixd(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1)); // (x, y, z) to (x, -z, y), without rounding
    turn->addChild(&files);
    return turn;
}

/// How high the floor is that the scene stands on; nullopt: it has none. Of rays straight down a third meet what lies level, as
/// the lowest thing that any of them meets; something stands above it, and next to nothing is below.
std::optional<double> floorOf(osg::Node& scene, const osg::BoundingBoxd& bounds) {
    osg::ref_ptr<osgUtil::IntersectorGroup> rays = new osgUtil::IntersectorGroup;
    const osg::Vec3d size = bounds._max - bounds._min;
    for (int i = 0; i < raysASide * raysASide; ++i) { // off the middle, where triangles meet
        const osg::Vec3d from(bounds.xMin() + size.x() * (i % raysASide + 0.37) / raysASide,
                              bounds.yMin() + size.y() * (i / raysASide + 0.71) / raysASide, bounds.zMax() + size.z());
        const osg::Vec3d to(from.x(), from.y(), bounds.zMin() - size.z());
        rays->addIntersector(new osgUtil::LineSegmentIntersector(osgUtil::Intersector::MODEL, from, to, nullptr,
                                                                 osgUtil::Intersector::LIMIT_NEAREST));
    }
    osgUtil::IntersectionVisitor visitor(rays);
    scene.accept(visitor);
    std::vector<double> met;
    for (const osg::ref_ptr<osgUtil::Intersector>& each : rays->getIntersectors()) {
        auto& ray = static_cast<osgUtil::LineSegmentIntersector&>(*each);
        if (ray.containsIntersections()) met.push_back(ray.getFirstIntersection().getWorldIntersectPoint().z());
    }
    if (met.empty()) return std::nullopt;
    const double lowest = *std::min_element(met.begin(), met.end()), top = lowest + floorHeight * bounds.radius();
    if (!(bounds.zMax() > top) || lowest > bounds.zMin() + floorDepth * bounds.radius()) return std::nullopt;
    const auto level = std::count_if(met.begin(), met.end(), [top](double height) { return height <= top; });
    return 3 * level > raysASide * raysASide ? std::optional<double>(lowest) : std::nullopt;
}

/// Whether a ground is asked for, if there is no floor.
bool asksForGround(const ViewOptions& o, osg::Node& scene) {
    return o.ground != "none" && !findNamed(scene, "ground") && !findNamed(scene, o.receiver);
}

/// Of all that stands above a floor, or above nodes named ground; of all there is without either, and where the floor is not
/// much wider than what stands on it, as the page of a book is.
osg::BoundingBoxd castersOf(osg::Node& scene, const osg::BoundingBoxd& bounds, const std::vector<NamedNode>& grounds,
                            const std::optional<double>& floor) {
    if (grounds.empty() && !floor) return bounds;
    const double foot = floor.value_or(bounds.zMin());
    std::vector<osg::Node::NodeMask> masks;
    for (const NamedNode& ground : grounds) masks.push_back(ground.node->getNodeMask()), ground.node->setNodeMask(0);
    VertexTraverser traverser;
    scene.accept(traverser);
    for (std::size_t i = grounds.size(); i-- > 0;)
        grounds[i].node->setNodeMask(masks[i]); // one may stand at several places
    osg::BoundingBoxd box;
    const std::vector<unsigned>& corners = traverser.getTriangles();
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) { // whole triangles: a page may be hinged at the floor
        osg::BoundingBoxd triangle;
        for (std::size_t k = i; k < i + 3; ++k) triangle.expandBy(traverser.getVertices()[corners[k]]);
        if (triangle.zMax() > foot + floorHeight * bounds.radius()) box.expandBy(triangle);
    }
    if (!box.valid() || (grounds.empty() && bounds.radius() < widestPart * box.radius())) return bounds;
    if (grounds.empty()) box.zMin() = foot;
    return box;
}

osg::BoundingBoxd worldBounds(const NamedNode& named) {
    const osg::BoundingBoxd local = sceneBounds(*named.node);
    osg::BoundingBoxd bounds;
    for (unsigned i = 0; local.valid() && i < 8; ++i) bounds.expandBy(local.corner(i) * named.rootFromParent);
    return bounds;
}

/// Where the light throws a point onto a level ground; the point itself under a light below it.
osg::Vec3d thrown(const osg::Vec3d& point, const osg::Vec4d& light, double ground) {
    const osg::Vec3d place(light.x(), light.y(), light.z()), way = place - point * light.w(); // to the light
    const double height = point.z() - ground;
    return way.z() > 0.0 && height > 0.0 ? point - way * (height / way.z()) : point;
}

/// Corners of what casts and of its shadow by the first light, as far as there is ground: within `reach`.
/// @param floor  its height, where no node is named ground.
std::vector<osg::Vec3d> framedBy(osg::Node& scene, const osg::BoundingBoxd& bounds, const SceneLights& lights,
                                 const osg::BoundingBoxd& reach, const std::optional<double>& floor) {
    const std::vector<NamedNode> grounds = findAllNamed(scene, "ground");
    const osg::BoundingBoxd casters = castersOf(scene, bounds, grounds, floor);
    const double foot = floor.value_or(bounds.zMin());
    const double ground = grounds.empty() ? foot : std::max(foot, worldBounds(grounds.front()).zMax());
    const std::vector<osg::Vec4d> places = lights.places();
    std::vector<osg::Vec3d> points;
    for (unsigned i = 0; i < 8; ++i) {
        points.push_back(casters.corner(i));
        if (places.empty()) continue;
        osg::Vec3d shadow = thrown(points.back(), places.front(), ground);
        for (int axis = 0; axis < 2; ++axis)
            shadow[axis] = std::clamp(shadow[axis], reach._min[axis], reach._max[axis]);
        points.push_back(shadow);
    }
    return points;
}

/// The lowest of what is named ground, or of a floor without such a name.
std::optional<double> lowestGround(osg::Node& root, const std::optional<double>& floor) {
    osg::BoundingBoxd all;
    for (const NamedNode& ground : findAllNamed(root, "ground")) all.expandBy(worldBounds(ground));
    return all.valid() ? all.zMin() : floor;
}

/// "lab8, ground, sphere, cube"; of many the first, and how many more.
std::string namesIn(osg::Node& root) {
    constexpr std::size_t few = 10, most = 1000;
    const std::vector<std::string> names = nodeNames(root, most);
    std::string text;
    for (std::size_t i = 0; i < std::min(few, names.size()); ++i) text += (i ? ", " : "") + names[i];
    if (names.size() <= few) return text;
    return text + " and " + (names.size() < most ? "" : "at least ") + std::to_string(names.size() - few) + " more";
}

Selection selectCasters(const std::string& casters, osg::Node& root) {
    Selection selection;
    if (casters == "all") return selection;
    if (casters == "none") {
        selection.mask = 0;
        return selection;
    }
    selection = selectionOf(findAllNamed(root, casters));
    if (selection.node) return selection;
    const std::string names = namesIn(root);
    throw std::invalid_argument("--casters: no node is named \"" + casters + "\". Allowed: all, none" +
                                (names.empty() ? "; no node here has a name." : ", or a node's name: " + names + "."));
}

/// Whether a scene casts shadows by techniques of its own.
bool castsByItself(osg::Node& scene) {
    struct Finder : public osg::NodeVisitor {
        Finder() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
        void apply(osg::Node& node) override {
            found = found || dynamic_cast<ShadowTechnique*>(&node);
            if (!found) traverse(node);
        }
        bool found = false;
    } finder;
    scene.accept(finder);
    return finder.found;
}

double aspectOf(const ViewOptions& o) { return double(o.width) / o.height; }

osg::Vec3d framedEye(const ViewOptions& o, const osg::Vec3d& center, double radius) {
    const double halfHeight = std::tan(osg::DegreesToRadians(o.fovy) / 2.0);
    const double half = std::atan(halfHeight * std::min(1.0, aspectOf(o)));
    const double distance = (radius > 0.0 ? radius : 1.0) * framingMargin / std::sin(half);
    const osg::Vec4d towards = sunAt(framingAzimuth, framingElevation); // where a sun would be
    return center + osg::Vec3d(towards.x(), towards.y(), towards.z()) * distance;
}

/// The nearest place from which all points are in the picture, looking along `view`: each side of the picture is a plane, and a
/// point asks that it lie no nearer. @return the eye, and what is straight ahead amid the points.
Lookout fittedTo(const std::vector<osg::Vec3d>& points, const ViewOptions& o, const osg::Vec3d& view,
                 const osg::Vec3d& up) {
    const double halfHeight = std::tan(osg::DegreesToRadians(o.fovy) / 2.0) / fittingMargin;
    const double slope[] = {halfHeight * aspectOf(o), halfHeight};
    const osg::Matrixd turn = osg::Matrixd::lookAt(osg::Vec3d(), view, up); // x is right, y is up, z towards the viewer
    double distance = -std::numeric_limits<double>::infinity(), low[2], high[2], middle = 0.0;
    for (int axis = 0; axis < 2; ++axis) {
        low[axis] = std::numeric_limits<double>::infinity(), high[axis] = -low[axis];
        for (const osg::Vec3d& point : points) {
            const osg::Vec3d p = point * turn;
            low[axis] = std::min(low[axis], p[axis] - slope[axis] * p.z());
            high[axis] = std::max(high[axis], p[axis] + slope[axis] * p.z());
            middle += p.z() / (2.0 * double(points.size()));
        }
        distance = std::max(distance, (high[axis] - low[axis]) / (2.0 * slope[axis]));
    }
    const osg::Matrixd back = osg::Matrixd::inverse(turn);
    const double x = (low[0] + high[0]) / 2.0, y = (low[1] + high[1]) / 2.0;
    return {osg::Vec3d(x, y, distance) * back,
            osg::Vec3d(x, y, std::min(middle, distance - 1e-3 * std::abs(distance))) * back, up};
}

osg::Vec3d chooseUp(const ViewOptions& o, osg::Vec3d view) {
    view.normalize();
    const osg::Vec3d up =
        o.viewUp.value_or(std::abs(view.z()) > 1.0 - 1e-12 ? osg::Vec3d(0, 1, 0) : osg::Vec3d(0, 0, 1));
    osg::Vec3d across = view ^ up;
    if (!(across.length() > 1e-9 * up.length()))
        throw std::invalid_argument("--viewup is parallel to the view. Give a vector at an angle to it.");
    return up;
}

void placeOrthographic(osg::Camera& camera, double half, double aspect) {
    camera.setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
    camera.setProjectionMatrixAsOrtho(-half * aspect, half * aspect, -half, half, -half, half);
}

} // namespace

void SceneSetup::show(bool shadows) {
    for (const osg::ref_ptr<ShadowTechnique>& technique : techniques) technique->setNodeMask(shadows ? ~0u : 0u);
}

namespace {

/// Each cause once. @param causesOf  gives those of a technique.
template <class Ask>
std::vector<std::string> causesOfAll(const std::vector<osg::ref_ptr<ShadowTechnique>>& techniques, Ask causesOf) {
    std::vector<std::string> causes;
    for (const osg::ref_ptr<ShadowTechnique>& technique : techniques)
        for (const std::string& cause : causesOf(*technique))
            if (std::find(causes.begin(), causes.end(), cause) == causes.end()) causes.push_back(cause);
    return causes;
}

} // namespace

std::vector<std::string> diagnoses(const std::vector<osg::ref_ptr<ShadowTechnique>>& techniques) {
    return causesOfAll(techniques, [](const ShadowTechnique& technique) { return technique.diagnose(); });
}

bool SceneSetup::mayCast() const { return group->getCasters().mask != 0 || group->areCastersGone(); }

std::vector<std::string> SceneSetup::diagnose() const {
    const std::vector<std::string> causes = diagnoses(techniques);
    return mayCast() ? causes : std::vector<std::string>();
}

std::vector<std::string> SceneSetup::causes() const {
    if (!mayCast()) return {};
    return causesOfAll(techniques, [](const ShadowTechnique& technique) { return technique.lastReport().causes; });
}

std::string SceneSetup::lowLight() const {
    if (!ground || techniques.empty() || !mayCast()) return "";
    for (const osg::Vec4d& place : lights->places()) {
        const bool isLamp = place.w() != 0.0;
        const double least = isLamp ? *ground : 0.0;
        if ((isLamp ? place.z() / place.w() : place.z()) > least) continue;
        std::ostringstream text;
        text << "the light " << place.x() << "," << place.y() << "," << place.z() << "," << place.w()
             << " does not stand above the ground, so no shadow falls there; give --light x,y,z," << place.w()
             << " with z above " << least << ".";
        return text.str();
    }
    return "";
}

std::vector<std::string> SceneSetup::notes() const {
    std::vector<std::string> all;
    for (const std::string& each : {note, lowLight()})
        if (!each.empty()) all.push_back(each);
    return all;
}

void SceneSetup::cast(std::vector<ShadowSpec> specs) {
    for (const osg::ref_ptr<ShadowTechnique>& technique : techniques) group->removeChild(technique);
    techniques.clear();
    for (ShadowSpec& spec : specs)
        if (spec.receiver.empty()) spec.receiver = receiver;
    techniques = addShadows(*group, specs);
    diagnose(); // who asks is not warned by osg::notify() besides
}

void SceneSetup::castAsComposed(const std::vector<ShadowSpec>& specs) {
    const ShadowCasterGroup::Composite composite = group->getComposite();
    cast(specs);
    group->setComposite(composite);
}

osg::Vec3d SceneSetup::farColour() const {
    if (hasAddedGround) return lights->groundColour(std::nullopt);
    const osg::Vec3d colour = lights->groundColour(bounds.center());
    const double mean = (colour.x() + colour.y() + colour.z()) / 3.0;
    return {mean, mean, mean};
}

void SceneSetup::toggleComposite() {
    group->setComposite(blends() ? ShadowCasterGroup::RELIGHT : ShadowCasterGroup::BLEND);
}

SceneSetup groupScene(const ViewOptions& options, osg::Node& files) {
    SceneSetup setup;
    setup.root = new osg::Group;
    setup.group = new ShadowCasterGroup;
    setup.group->addChild(upright(files, options.yUp));
    setup.root->addChild(setup.group);
    return setup;
}

void SceneSetup::furnish(const ViewOptions& options) {
    osg::Node& scene = *group->getChild(0);
    bounds = sceneBounds(scene);
    const bool asks = asksForGround(options, scene), isAuto = options.ground == "auto";
    const bool isFramed = !options.eye && !options.center;
    std::optional<double> floor;
    if ((asks && isAuto) || isFramed) floor = floorOf(scene, bounds);
    const double side = !asks     ? 0.0
                        : !isAuto ? std::stod(options.ground)
                        : floor   ? 0.0
                                  : options.groundRadii * bounds.radius();
    const osg::ref_ptr<osg::Node> added = side > 0.0 ? makeGround(bounds, side) : nullptr;
    hasAddedGround = added.valid();
    if (added) group->addChild(added);
    if (added && isAuto)
        note =
            "the scene has no floor and no node named ground, so it got a white ground; --ground none leaves it out.";
    lights = std::make_unique<SceneLights>(options, *root, *group, bounds.center());
    if (added) lights->shineOn(*added);
    ground = lowestGround(*group, floor);
    osg::BoundingBoxd reach = bounds;
    if (added)
        reach.expandBy(isAuto ? sceneBounds(*makeGround(bounds, framedRadii * bounds.radius())) : sceneBounds(*added));
    if (isFramed) framed = framedBy(scene, bounds, *lights, reach, floor);
    group->setCasters(selectCasters(options.casters, *group));
    receiver = options.receiver;
    if (!options.isUsual || !castsByItself(scene)) cast(options.shadows);
}

SceneSetup setUpScene(const ViewOptions& options, osg::Node& files) {
    SceneSetup setup = groupScene(options, files);
    setup.furnish(options);
    return setup;
}

Lookout lookout(const ViewOptions& options, const SceneSetup& setup) {
    const osg::Vec3d center = options.center.value_or(setup.bounds.center());
    const osg::Vec3d eye = options.eye.value_or(framedEye(options, center, setup.bounds.radius()));
    if (eye == center) throw std::invalid_argument("--eye is the scene's centre. Give another --eye, or a --center.");
    const osg::Vec3d view = center - eye, up = chooseUp(options, view);
    return setup.framed.empty() ? Lookout{eye, center, up} : fittedTo(setup.framed, options, view, up);
}

void placeCamera(osg::Camera& camera, const ViewOptions& options, const SceneSetup& setup) {
    const Lookout place = lookout(options, setup);
    camera.setViewMatrixAsLookAt(place.eye, place.center, place.up);
    const osg::Vec3d background = options.background ? *options.background : setup.farColour();
    camera.setClearColor(osg::Vec4(osg::Vec3(background), 1.0f));
    if (options.orthographic) return placeOrthographic(camera, *options.orthographic, aspectOf(options));
    if (options.zNear) camera.setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
    camera.setProjectionMatrixAsPerspective(options.fovy, aspectOf(options), options.zNear.value_or(1.0),
                                            options.zFar.value_or(1e4));
}

namespace {

constexpr double leastNearToFar = 0.0005; // CullSettings' own near-far ratio
constexpr double slack = 1.01;            // so that nothing lies on a plane

struct Depths {
    double near, far;
};

Depths depthsOf(const osg::BoundingBoxd& bounds, const osg::Matrixd& view) {
    double nearest = -(bounds.corner(0) * view).z(), farthest = nearest;
    for (unsigned i = 1; i < 8; ++i) {
        const double depth = -(bounds.corner(i) * view).z();
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    const double far = farthest > 0.0 ? farthest * slack : 1.0; // all of it may be behind the camera
    return {std::max(nearest / slack, far * leastNearToFar), far};
}

} // namespace

SceneCamera sceneCamera(const osg::Camera& camera, int width, int height, const osg::BoundingBoxd& bounds) {
    SceneCamera result{camera.getViewMatrix(), camera.getProjectionMatrix(), width, height};
    double fovy, aspect, near, far;
    if (camera.getComputeNearFarMode() == osg::Camera::DO_NOT_COMPUTE_NEAR_FAR || !bounds.valid() ||
        !result.projection.getPerspective(fovy, aspect, near, far))
        return result;
    const Depths depths = depthsOf(bounds, result.view);
    result.projection.makePerspective(fovy, aspect, depths.near, depths.far);
    return result;
}

} // namespace gnomon::examples
