// SPDX-License-Identifier: MIT
#include "ReportFigures.h"

#include "CausesFigure.h"
#include "Gnuplot.h"
#include "GnuplotText.h"
#include "PredictionFigure.h"

#include <algorithm>
#include <cctype>

namespace gnomon::examples {
namespace {

/// Fit for a file's name.
std::string fileName(const std::string& begin, const std::string& scene) {
    std::string name = scene.empty() ? begin : begin + "-" + scene;
    for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '-';
    return name;
}

const char* titleOf(LightMotion light) {
    return light == LightMotion::Still ? "The light is still, the camera moves" : "The light moves with every frame";
}

FigurePanel panelOf(const ChartResults& results, const std::string& scene, LightMotion light) {
    return {light == LightMotion::Still ? "still" : "moving", titleOf(light),
            scene.empty() ? pooledCurves(results, light) : sceneCurves(results, scene, light),
            boundaryFloor(results, scene)};
}

std::string madeOf(const ChartResults& results, const std::string& name) {
    for (const auto& [key, value] : results.made)
        if (key == name) return value;
    return "";
}

/// "llvmpipe (…), AMD …, 2026-11-21": as much as is known.
std::string remarkOf(const ChartResults& results) {
    std::string remark;
    for (const char* name : {"renderer", "processor", "date"}) {
        const std::string value = madeOf(results, name);
        if (!value.empty()) remark += (remark.empty() ? "" : "; ") + value;
    }
    return results.complete ? remark : "INCOMPLETE. " + remark;
}

std::string titleOf(const ChartResults& results, const std::string& scene) {
    if (scene.empty() && results.scenes.size() == 1) return results.scenes.front().title;
    if (scene.empty()) return std::to_string(results.scenes.size()) + " scenes";
    for (const ChartSceneResult& each : results.scenes)
        if (each.name == scene) return each.title;
    return scene;
}

Figure figureOf(const ChartResults& results, const std::string& scene) {
    Figure figure{fileName("figure", scene),
                  titleOf(results, scene) + ": how fast shadows are, and how wrong",
                  remarkOf(results),
                  {},
                  1};
    for (const LightMotion light : {LightMotion::Still, LightMotion::Moving})
        figure.panels.push_back(panelOf(results, scene, light));
    if (scene.empty()) figure.scenes = results.scenes.size();
    return figure;
}

/// What was measured or tried and has no place in a chart.
std::string leftOut(const FigurePanel& panel) {
    std::string names;
    for (const Curve& curve : panel.curves)
        for (const CurvePoint& point : curve.points)
            if (!point.shown()) names += (names.empty() ? "" : "; ") + curve.technique + ", " + point.setting;
    return names.empty() ? "" : " Not drawn, because a time or a boundary is missing: " + names + ".";
}

std::string captionOf(const Figure& figure, const std::string& scene) {
    const std::string pooled = "Each marker is one technique at one setting: its median time and median error over the "
                               "scenes in which it was tried. A failure or a missing boundary counts as an infinite "
                               "error. ";
    return (scene.empty() ? pooled : "Each marker is one technique at one setting in this scene. ") +
           "Left is faster, down is more accurate. The horizontal axis shows the wall time that shadows add to a "
           "frame, "
           "with its quartiles. The vertical axis shows the distance in pixels within which 95 % of the shadow's "
           "boundary lies from the true one. A hollow marker failed or is catastrophic in " +
           (scene.empty() ? "some scene. " : "this scene. ") +
           "The broad line joins the best solid markers: those that no faster marker beats. Values below " +
           plotNumber(leastShownTime) + " ms or " + plotNumber(leastShownError) + " px are drawn there." +
           leftOut(figure.panels.front());
}

const char* causesCaption =
    "Why pixels away from edges are wrong. Acne and halo are false shadow, far from a true shadow or attached to one. "
    "Peter-panning, leak and erosion are missed shadow, at the foot of the caster, inside a shadow or at its edge. The "
    "right column shows the share of the judged pixels that are wrong.";

const char* predictedCaption =
    "What the model of auto predicts before anything is drawn, and what was measured. Each marker is one setting in "
    "one "
    "scene. On the line both are equal. Within the dashed lines, an error is right to a factor of 1.5 and a time to a "
    "factor of 2. Each setting has two times: with a still and with a moving light.";

void addScene(std::vector<DrawnFigure>& drawn, const ChartResults& results, const CurveStyles& styles,
              const std::string& scene, const std::string& folder) {
    const Figure figure = figureOf(results, scene);
    drawFigure(figure, styles, folder);
    drawn.push_back({figure.name, scene, captionOf(figure, scene)});
    const std::string title = titleOf(results, scene);
    const auto add = [&](const std::string& name, const std::optional<FigureScript>& script, const char* caption) {
        if (!script) return;
        drawScript(name, *script, folder);
        drawn.push_back({name, scene, caption});
    };
    const std::string causes = fileName("causes", scene), predicted = fileName("predicted", scene);
    add(causes, causesScript(results, styles, causes, title + ": why pixels are wrong", scene), causesCaption);
    add(predicted, predictionScript(results, styles, predicted, title + ": what auto predicts", scene),
        predictedCaption);
}

} // namespace

std::vector<DrawnFigure> drawFigures(const ChartResults& results, const std::string& folder) {
    const CurveStyles styles(results);
    std::vector<DrawnFigure> drawn;
    addScene(drawn, results, styles, "", folder);
    for (const ChartSceneResult& scene : results.scenes) addScene(drawn, results, styles, scene.name, folder);
    return drawn;
}

} // namespace gnomon::examples
