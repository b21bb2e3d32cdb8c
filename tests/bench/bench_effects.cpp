// SPDX-License-Identifier: MIT
// What a mirror and halos make of a frame, as a multiple of the frame without, beside drawing all of it twice, in one
// interleaved run; the pictures are checked.
#include "Contenders.h"

#include <FrameTime.h>
#include <support/Oracle.h>

#include <gnomon/HaloNode.h>
#include <gnomon/PlanarReflectionNode.h>

#include <glm/common.hpp>
#include <osg/MatrixTransform>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

const osg::Vec4d sun(1.0, 0.3, 1.2, 0.0), mirroredSun(1.0, 0.3, -1.2, 0.0);
constexpr double reflectance = 0.7, opacity = 0.3;
const glm::dvec3 yellow(204.0, 204.0, 0.0);

struct Setting {
    std::string name;
    std::vector<test::Mesh> things;
    double groundHalf;
    test::View view;
};

osg::ref_ptr<osg::Group> nodesOf(const Setting& setting) {
    osg::ref_ptr<osg::Group> group = new osg::Group;
    for (const test::Mesh& mesh : setting.things) group->addChild(test::node(mesh));
    return group;
}

osg::ref_ptr<gnomon::HaloNode> halo(gnomon::HaloNode::Shape shape) {
    osg::ref_ptr<gnomon::HaloNode> node = new gnomon::HaloNode;
    node->setShape(shape);
    node->setScale(1.1);
    return node;
}

osg::ref_ptr<osg::Group> mirror(osg::Node* ground) {
    osg::ref_ptr<gnomon::PlanarReflectionNode> node = new gnomon::PlanarReflectionNode;
    node->setSurface({ground});
    node->setReflectance(osg::Vec3f(1, 1, 1) * float(reflectance));
    return node;
}

osg::ref_ptr<osg::Group> effect(const std::string& name, osg::Node* ground) {
    if (name == "mirror") return mirror(ground);
    if (name == "halo whole") return halo(gnomon::HaloNode::WHOLE);
    if (name == "halo parts") return halo(gnomon::HaloNode::PARTS);
    if (name == "halo 3 pixels") return halo(gnomon::HaloNode::PIXELS);
    return new osg::Group;
}

test::Scene sceneOf(const Setting& setting, const std::string& name) {
    test::Scene scene = test::scene(sun);
    const osg::ref_ptr<osg::Node> ground = test::node(test::square(setting.groundHalf));
    const osg::ref_ptr<osg::Group> group = effect(name, ground);
    group->addChild(nodesOf(setting));
    scene.content->addChild(ground);
    scene.content->addChild(group);
    if (name == "twice") scene.content->addChild(nodesOf(setting)), scene.content->addChild(ground);
    return scene;
}

test::Picture picture(const Setting& setting, const std::string& name) {
    return test::render(sceneOf(setting, name).root, setting.view);
}

glm::dvec3 colorAt(const test::Picture& picture, int x, int y) {
    const std::uint32_t pixel = picture.at(x, y);
    return {pixel & 0xffu, pixel >> 8 & 0xffu, pixel >> 16 & 0xffu};
}

double apart(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 off = glm::abs(a - b);
    return std::max({off.x, off.y, off.z});
}

/// What lies behind the ground's plane, without the ground.
test::Picture mirrorWorld(const Setting& setting) {
    test::Scene scene = test::scene(mirroredSun);
    scene.root->getOrCreateStateSet()->setMode(GL_NORMALIZE, osg::StateAttribute::ON);
    osg::ref_ptr<osg::MatrixTransform> flip = new osg::MatrixTransform(osg::Matrixd::scale(1.0, 1.0, -1.0));
    flip->addChild(nodesOf(setting));
    scene.content->addChild(flip);
    return test::render(scene.root, setting.view);
}

/// On the ground 30 % of its own and 70 % of what is mirrored there, or beside there, at an edge of that; elsewhere nothing.
int wrongInMirror(const Setting& setting) {
    const test::Picture plain = picture(setting, "none"), drawn = picture(setting, "mirror"),
                        image = mirrorWorld(setting);
    const test::Mask mask = test::castRays(test::square(setting.groundHalf), setting.things, sun, setting.view);
    int wrong = 0;
    for (int y = 1; y + 1 < plain.height; ++y)
        for (int x = 1; x + 1 < plain.width; ++x) {
            if (mask.atEdge(x, y)) continue;
            const bool ground =
                mask.at(x, y) == test::Seen::LitReceiver || mask.at(x, y) == test::Seen::ShadowedReceiver;
            bool right = !ground && plain.at(x, y) == drawn.at(x, y);
            for (int i = 0; ground && i < 9; ++i)
                right = right || apart(colorAt(drawn, x, y),
                                       colorAt(plain, x, y) * (1.0 - reflectance) +
                                           colorAt(image, x + i % 3 - 1, y + i / 3 - 1) * reflectance) < 2.0;
            wrong += !right;
        }
    return wrong;
}

/// What has changed is blended once.
int wrongInHalo(const Setting& setting, const std::string& name) {
    const test::Picture plain = picture(setting, "none"), drawn = picture(setting, name);
    int wrong = 0, changed = 0;
    for (int y = 0; y < plain.height; ++y)
        for (int x = 0; x < plain.width; ++x) {
            if (plain.at(x, y) == drawn.at(x, y)) continue;
            ++changed;
            const glm::dvec3 once = yellow * opacity + colorAt(plain, x, y) * (1.0 - opacity);
            wrong += apart(colorAt(drawn, x, y), once) > 1.6;
        }
    return changed > 0 ? wrong : 1;
}

bool run(const Setting& setting, int frames) {
    const std::vector<std::string> names = {"none", "mirror", "halo whole", "halo parts", "halo 3 pixels", "twice"};
    std::printf("%s, 800x600\n", setting.name.c_str());
    std::vector<bench::Contender> contenders;
    for (const std::string& name : names)
        contenders.push_back(bench::contender(name, sceneOf(setting, name).root, setting.view));
    bench::race(contenders, frames);
    const auto times = [&](std::size_t i) { return gnomon::examples::quartiles(contenders[i].cpu).median; };
    int wrong = wrongInMirror(setting);
    for (std::size_t i = 1; i < names.size(); ++i) {
        std::printf("  %-14s %.2f of the frame without, by processor time\n", names[i].c_str(), times(i) / times(0));
        if (names[i].find("halo") == 0) wrong += wrongInHalo(setting, names[i]);
    }
    std::printf("  pictures: %d pixels wrong\n", wrong);
    return wrong == 0;
}

int measure(osg::ArgumentParser& arguments) {
    const auto frames = bench::framesAsked(
        arguments, "Cost of a mirror and of halos beside drawing all of it twice; medians of interleaved frames.");
    if (!frames) return 0;
    bool right = run({"sphere and box on a ground",
                      {test::sphere({-2.0, 0.0, 2.5}, 1.0), test::house({2.0, 0.0}, {2.0, 2.0, 2.0}, 30.0)},
                      8.0,
                      test::perspective({-8.0, -14.0, 10.0}, {0.0, 0.0, 0.0}, 800, 600)},
                     *frames);
    right = run({"flat town of 400 boxes", test::town(20), 55.0,
                 test::perspective({-50.0, -70.0, 50.0}, {0.0, 0.0, 0.0}, 800, 600, 40.0, 1.0, 300.0)},
                *frames) &&
            right;
    return right ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram("bench_effects", argc, argv, measure); }
