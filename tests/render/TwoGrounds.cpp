// SPDX-License-Identifier: MIT
#include "TwoGrounds.h"

#include "GlComplaints.h"
#include <support/Causes.h>

#include <algorithm>

namespace test {
namespace {

const Mesh leftGround = quad({-5.0, -4.0, 0.0}, {5.0, 0.0, 0.0}, {0.0, 8.0, 0.0});
const Mesh rightGround = moved(leftGround, {5.0, 0.0, 0.0});
const Mesh smallHouse = moved(house({0.4, 0.5}, {2.4, 1.8, 1.5}, 20.0), {0.0, 0.0, 0.3});
const Mesh screen = quad({-2.6, -1.6, 0.2}, {1.2, 0.0, 0.0}, {0.0, 0.1, 0.9});

osg::Node* receiverOf(const TwoGrounds& place, osg::Node& root) {
    if (place.named == Named::Nothing) return nullptr;
    return find(root, place.named == Named::Both ? "grounds" : "left");
}

bool allZero(const osg::Image& image) {
    return std::all_of(image.data(), image.data() + image.getTotalSizeInBytes(), [](auto v) { return v == 0; });
}

std::string joined(const std::vector<std::string>& sentences) {
    std::string all;
    for (const std::string& sentence : sentences) all += " " + sentence;
    return all;
}

bool saysJust(const gnomon::ShadowTechnique& technique, const std::string& part) {
    const std::vector<std::string> causes = causesButLitSurfaces(technique); // the screen stands before the house
    return part.empty() ? causes.empty() : causes.size() == 1 && causes[0].find(part) != std::string::npos;
}

::testing::AssertionResult isQuiet(Camera& camera, const GlComplaints& complaints,
                                   const gnomon::ShadowTechnique& technique, const std::string& cause) {
    if (!complaints.all().empty()) return ::testing::AssertionFailure() << "OpenGL says" << joined(complaints.all());
    if (!saysJust(technique, cause))
        return ::testing::AssertionFailure() << "diagnose() says" << joined(technique.diagnose());
    if (!allZero(*camera.context().stencil())) return ::testing::AssertionFailure() << "stencil bits are left";
    return ::testing::AssertionSuccess();
}

} // namespace

Scene TwoGrounds::build() const {
    Scene result = scene(light);
    osg::ref_ptr<osg::Group> grounds = new osg::Group;
    grounds->setName("grounds");
    grounds->addChild(node(leftGround, "left"));
    grounds->addChild(node(rightGround, "right"));
    result.content->addChild(grounds);
    result.content->addChild(node(smallHouse, "house"));
    result.content->addChild(node(screen, "screen"));
    return result;
}

osg::ref_ptr<gnomon::PlanarShadowNode> TwoGrounds::addShadow(Scene& scene) const {
    const auto technique = planar(receiverOf(*this, *scene.root));
    scene.addShadow(technique);
    return technique;
}

Mask TwoGrounds::mask(const Mesh& over, const Mesh& before) const {
    std::vector<Mesh> casters = {smallHouse, screen, before};
    if (named == Named::Left) casters.push_back(rightGround); // hides nothing of the left one, and casts nothing on it
    if (named != Named::Nothing) casters.push_back(moved(over, {0.0, 0.0, 1e-6}));
    std::vector<Mesh> receivers = {leftGround};
    if (named != Named::Left) receivers.push_back(rightGround);
    if (named == Named::Nothing) receivers.push_back(over);
    return castRays(test::joined(receivers), casters, light, view);
}

std::vector<TwoGrounds> allTwoGrounds() {
    std::vector<TwoGrounds> all;
    for (const osg::Vec4d& light : {osg::Vec4d(1.0, 0.3, 1.2, 0.0), osg::Vec4d(2.0, -3.0, 5.0, 1.0)})
        for (const Named named : {Named::Nothing, Named::Both, Named::Left}) {
            TwoGrounds place;
            place.light = light;
            place.named = named;
            all.push_back(place);
        }
    return all;
}

std::string nameOf(const TwoGrounds& given) {
    const std::string receiver = given.named == Named::Nothing ? "Unnamed"
                                 : given.named == Named::Both  ? "BothNamed"
                                                               : "LeftNamed";
    return (given.light.w() == 0.0 ? "Sun" : "Lamp") + receiver;
}

std::ostream& operator<<(std::ostream& out, const TwoGrounds& given) { return out << nameOf(given); }

Frames frames(Camera& camera) {
    Frames result{camera.frame(), {}};
    camera.frame();
    result.third = camera.frame();
    return result;
}

Frames unshadowed(const TwoGrounds& place, const Trial& trial, bool dark) {
    Scene scene = place.build();
    trial.change(scene);
    if (dark) scene.takeLightAway();
    Camera camera(scene.root, place.view);
    trial.set(camera);
    return frames(camera);
}

Picture cropped(const Picture& picture, int left, int bottom, int width, int height) {
    Picture part;
    part.width = width;
    part.height = height;
    for (int y = bottom; y < bottom + height; ++y)
        for (int x = left; x < left + width; ++x) part.pixels.push_back(picture.at(x, y));
    return part;
}

::testing::AssertionResult judge(const Picture& actual, const Picture& lit, const Picture& dark, const Mask& mask) {
    if (mask.count(Seen::ShadowedReceiver) < 200) return ::testing::AssertionFailure() << "no shadow to judge";
    const Comparison found = compare(actual, lit, dark, mask);
    if (found.wrongInside + found.wrongAtEdge == 0 && found.flipped <= found.edges / 30)
        return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << found.wrongInside << " pixels away from edges are wrong, "
                                         << found.wrongAtEdge << " at edges are neither lit nor dark, " << found.flipped
                                         << " of " << found.edges << " at edges decided otherwise";
}

::testing::AssertionResult isExact(const TwoGrounds& place, const Trial& trial) {
    Scene scene = place.build();
    trial.change(scene);
    const auto technique = place.addShadow(scene);
    Camera camera(scene.root, place.view);
    trial.set(camera);
    GlComplaints complaints(camera);
    const Frames actual = frames(camera), lit = unshadowed(place, trial, false), dark = unshadowed(place, trial, true);
    const Mask mask = place.mask(trial.over, trial.before);
    if (auto first = judge(actual.first, lit.first, dark.first, mask); !first) return first << ", first frame";
    if (auto third = judge(actual.third, lit.third, dark.third, mask); !third) return third << ", third frame";
    return isQuiet(camera, complaints, *technique, place.named == Named::Nothing ? trial.cause : "");
}

} // namespace test
