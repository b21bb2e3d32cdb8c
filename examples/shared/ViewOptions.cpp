// SPDX-License-Identifier: MIT
#include "ViewOptions.h"

#include <sstream>
#include <stdexcept>

namespace gnomon::examples {
namespace {

using Text = const std::string&;

constexpr double smallestLength = 1e-9;
constexpr std::size_t mostLights = 8;
constexpr int largestSide = 16384;
constexpr int mostSamples = 16;
constexpr Lighting soft = {0.3, 0.65,
                           0.35};  // a white ground under a sun at 45 degrees is 0.93 of white, in shadow 0.47
constexpr double farRadii = 100.0; // where a lamp's light on the ground has faded

[[noreturn]] void refuse(const std::string& sentence) { throw std::invalid_argument(sentence); }

osg::Vec3d readVec3(Text text, double low = -largestNumber, double high = largestNumber) {
    const std::vector<double> n = readNumbers(text, 3, low, high);
    return {n[0], n[1], n[2]};
}

/// Of a light: one number is that of red, green and blue.
osg::Vec3d readColour(Text text) {
    constexpr double most = 10.0;
    if (text.find(',') != std::string::npos) return readVec3(text, 0.0, most);
    const double grey = readNumber(text, 0.0, most);
    return {grey, grey, grey};
}

SunMoment readSun(Text text) {
    const std::size_t comma = text.find(',');
    const auto day = julianDay(text.substr(0, comma));
    if (!day || comma == std::string::npos)
        refuse("Allowed: a moment in UTC as 2026-06-21T15:00:00Z, a latitude from -90 to 90 and a longitude from -180 "
               "to 180 degrees, separated by commas.");
    const std::vector<double> place = readNumbers(text.substr(comma + 1), 2);
    return {SunClock(place[0], place[1]), *day};
}

/// @throws std::invalid_argument if it is night.
void shine(ViewOptions& into, const SunMoment& sun) {
    const SunPosition at = sun.clock.at(sun.day);
    if (!(at.elevation > 0.0)) {
        std::ostringstream low;
        low.precision(3);
        low << -at.elevation;
        refuse("The sun is " + low.str() + " degrees below the horizon. Give a moment when it is up.");
    }
    const glm::dvec3 towards = sun.clock.towards(sun.day);
    into.sun = sun;
    into.lights.push_back({towards.x, towards.y, towards.z, 0.0});
}

std::string readGround(Text text) {
    if (text == "auto" || text == "none") return text;
    try {
        readNumber(text, smallestLength, largestNumber);
    } catch (const std::invalid_argument&) {
        refuse("Allowed: auto, none, or a side from 1e-09 to 1e+12.");
    }
    return text;
}

bool readUp(Text text) {
    if (text != "y" && text != "z") refuse("Allowed: y, z.");
    return text == "y";
}

void takeSize(ViewOptions& into, Text text) {
    const std::size_t cross = text.find('x');
    try {
        into.width = readWhole(text.substr(0, cross), 1, largestSide);
        into.height = cross == std::string::npos ? 0 : readWhole(text.substr(cross + 1), 1, largestSide);
    } catch (const std::invalid_argument&) {
        into.height = 0;
    }
    if (into.height == 0) refuse("Allowed: WIDTHxHEIGHT from 1x1 to 16384x16384 pixels.");
}

std::string asText(double number) {
    std::ostringstream text;
    text << number;
    return text.str();
}

/// What a part of the light is without its option.
std::string usual(const ViewOptions& o, double Lighting::*part, const std::string& plain,
                  const std::string& more = "") {
    return o.lighting ? asText((*o.lighting).*part) + more + "; of a scene with lights of its own: as it has it"
                      : plain;
}

void addFillOption(Options& table, ViewOptions& into) {
    table.push_back({"--fill", "F|r,g,b",
                     "diffuse part of a light without shadow, 0 to 10; it shines from the camera's side, 30 degrees "
                     "high and\n      at least 105 degrees from the first light, so that shapes stay visible in shadow",
                     usual(into, &Lighting::fill, "none"), [&into](Text t) { into.fill = readColour(t); }});
}

void addUpOption(Options& table, ViewOptions& into) {
    table.push_back({"--up", "y|z", "up axis of the files; y turns them by 90 degrees about x, so that z is up", "z",
                     [&into](Text t) { into.yUp = readUp(t); }});
}

void addCameraOptions(Options& table, ViewOptions& into) {
    table.push_back({"--eye", "x,y,z", "camera position, scene's unit",
                     "so that casters and their shadows fill the picture",
                     [&into](Text t) { into.eye = readVec3(t); }});
    table.push_back({"--center", "x,y,z", "point that the camera looks at, scene's unit", "the scene's centre",
                     [&into](Text t) { into.center = readVec3(t); }});
    table.push_back({"--viewup", "x,y,z", "up direction in the picture", "0,0,1; 0,1,0 when looking along z",
                     [&into](Text t) { into.viewUp = readVec3(t); }});
    table.push_back({"--fovy", "DEG", "vertical field of view, 0.001 to 170 degrees", "40",
                     [&into](Text t) { into.fovy = readNumber(t, 0.001, 170.0); }});
    table.push_back({"--near", "N", "distance of the near plane, scene's unit, used exactly; needs --far", "computed",
                     [&into](Text t) { into.zNear = readNumber(t, smallestLength, largestNumber); }});
    table.push_back({"--far", "F", "distance of the far plane, scene's unit, used exactly; needs --near", "computed",
                     [&into](Text t) { into.zFar = readNumber(t, smallestLength, largestNumber); }});
    table.push_back({"--background", "r,g,b", "background colour, 0 to 1 each",
                     into.background ? "0.2,0.2,0.4" : "that of a white ground in the distance",
                     [&into](Text t) { into.background = readVec3(t, 0.0, 1.0); }});
    table.push_back(
        {"--samples", "N", "samples a pixel, 1 to 16: more than 1 smooth all edges", std::to_string(into.samples),
         [&into](Text t) { into.samples = readWhole(t, 1, mostSamples), into.needsSamples = into.samples > 1; }});
    addSize(table, into);
}

void requireCamera(const ViewOptions& o) {
    if (o.eye && o.center && *o.eye == *o.center)
        refuse("--eye and --center are the same point. Give two different points.");
    if (o.viewUp && o.viewUp->length2() == 0.0) refuse("--viewup 0,0,0 is not a direction. Give any other vector.");
    if (!o.viewUp || !o.eye || !o.center) return;
    osg::Vec3d up = *o.viewUp, view = *o.center - *o.eye;
    up.normalize();
    view.normalize();
    if ((up ^ view).length() < 1e-9) refuse("--viewup is parallel to the view. Give a vector at an angle to it.");
}

void requireDepthRange(const ViewOptions& o) {
    if (o.zNear.has_value() != o.zFar.has_value()) refuse("--near and --far need each other. Give both or neither.");
    if (o.zNear && !(*o.zNear < *o.zFar)) refuse("--near must be less than --far.");
}

} // namespace

osg::Vec4d readLight(Text text, double most) {
    const std::vector<double> n = readNumbers(text, 4, -most, most);
    const bool isDirection = n[3] == 0.0 && (n[0] != 0.0 || n[1] != 0.0 || n[2] != 0.0);
    if (!isDirection && n[3] != 1.0)
        refuse("Allowed: a direction other than 0,0,0 with w = 0, or a position with w = 1.");
    return {n[0], n[1], n[2], n[3]};
}

void addShadowOptions(Options& table, ViewOptions& into) {
    table.push_back({"--shadow", "SPEC", "shadow technique and its keys, see SPEC below", into.usualShadow,
                     [&into](Text t) { into.shadows.push_back(parseShadowSpec(t)); }, true});
    table.push_back(
        {"--receiver", "NODENAME",
         "nodes of this name receive shadows, if SPEC names none; map, volume and traced then receive there alone",
         "as SPEC says", [&into](Text t) { into.receiver = t; }});
    table.push_back({"--casters", "all|none|NODENAME", "nodes that cast shadows: all of that name", "all",
                     [&into](Text t) { into.casters = t; }});
    table.push_back(
        {"--ground", "auto|none|SIZE",
         "white square ground under the scene, if no node is named ground; SIZE is its side in the scene's\n"
         "      unit; auto is " +
             asText(into.groundRadii) + " times the scene's radius, where the scene has no level floor",
         into.ground, [&into](Text t) { into.ground = readGround(t); }});
}

void addLightOptions(Options& table, ViewOptions& into) {
    table.push_back({"--light", "x,y,z,w",
                     "light; w = 0: direction towards a sun; w = 1: position of a lamp, scene's unit",
                     "the scene's lights, else a sun at azimuth 135, elevation 45 degrees; azimuth from north = +y "
                     "through east = +x",
                     [&into](Text t) { into.lights.push_back(readLight(t)); }, true});
    table.push_back({"--sun", "MOMENT,LAT,LON",
                     "sun as a light: UTC as 2026-06-21T15:00:00Z, degrees north and east; x is east, y north, z up",
                     "none", [&into](Text t) { shine(into, readSun(t)); }});
    table.push_back({"--ambient", "A|r,g,b",
                     "ambient light of the scene, 0 to 10; sets the lights' own ambient part to 0",
                     usual(into, &Lighting::ambient, "0.1, OSG's"), [&into](Text t) { into.ambient = readColour(t); }});
    table.push_back({"--diffuse", "D|r,g,b", "diffuse part of each light, 0 to 10",
                     usual(into, &Lighting::diffuse, "0.8, OSG's", " shared by all lights"),
                     [&into](Text t) { into.diffuse = readColour(t); }});
}

void addSize(Options& table, ViewOptions& into) {
    table.push_back({"--size", "WxH", "size of the picture, 1x1 to 16384x16384 pixels",
                     std::to_string(into.width) + "x" + std::to_string(into.height),
                     [&into](Text t) { takeSize(into, t); }});
}

ViewOptions pictureOptions(int samples) {
    ViewOptions options;
    options.samples = samples;
    options.lighting = soft;
    options.groundRadii = farRadii;
    options.background.reset();
    return options;
}

Options viewOptions(ViewOptions& into) {
    Options table;
    addShadowOptions(table, into);
    addUpOption(table, into);
    addLightOptions(table, into);
    if (into.lighting) addFillOption(table, into);
    addCameraOptions(table, into);
    return table;
}

void takeFiles(osg::ArgumentParser& arguments, ViewOptions& into) {
    refuseUnknownOptions(arguments);
    for (int i = 1; i < arguments.argc(); ++i) into.files.push_back(arguments[i]);
}

void takeUsualShadow(ViewOptions& into) {
    into.isUsual = into.shadows.empty();
    if (into.isUsual) into.shadows = {parseShadowSpec(into.usualShadow)};
}

std::string techniqueNames(const std::vector<ShadowSpec>& specs) {
    std::string names;
    for (const ShadowSpec& spec : specs) names += (names.empty() ? "" : " + ") + spec.text;
    return names.empty() ? "none" : names;
}

void requireConsistent(const ViewOptions& options) {
    requireCamera(options);
    requireDepthRange(options);
    if (options.lights.size() > mostLights) refuse("--light is given more than 8 times. Allowed: 1 to 8 lights.");
}

void readViewOptions(osg::ArgumentParser& arguments, const Options& table, ViewOptions& into, const bool& help) {
    readOptions(arguments, table);
    readOsgOptions(arguments);
    if (help) return;
    takeFiles(arguments, into);
    if (into.files.empty()) refuse("no scene file is given. See --help.");
    takeUsualShadow(into);
    requireConsistent(into);
}

} // namespace gnomon::examples
