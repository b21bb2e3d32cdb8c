// SPDX-License-Identifier: MIT
#include "ProcessorAlone.h"
#include "OtherProcess.h"
#include "Race.h"

#include <gnomon/HeadlessContext.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <stdexcept>

namespace gnomon::examples {

using nlohmann::json;

static void to_json(json& file, const AddedTime& time) { file = {time.q1, time.median, time.q3}; }
static void from_json(const json& file, AddedTime& time) { time = {file.at(0), file.at(1), file.at(2)}; }

namespace {

const std::string answer = "processor alone: "; // other lines are what libraries have to say

std::string commandOf(const AlonePlan& plan, const std::vector<Contender>& contenders, std::size_t from) {
    json request = {{"scene", plan.scene}, {"frames", plan.frames}, {"contenders", json::array()}};
    for (std::size_t i = from; i < contenders.size(); ++i)
        request["contenders"].push_back({contenders[i].technique, contenders[i].setting, contenders[i].settings});
    std::string command = "exec";
    for (const std::string& word : plan.command) command += " " + shellWord(word);
    return command + " " + shellWord(request.dump());
}

std::optional<AloneTimes> timesOf(const std::string& text) {
    const json file = json::parse(text);
    if (file.is_null()) return std::nullopt;
    return AloneTimes{file.at(0), file.at(1), file.at(2)};
}

/// @throws std::invalid_argument, one sentence, if the chart has none of this name.
Contender contenderOf(const std::string& technique, const std::string& setting, const Settings& settings) {
    for (const Peer& peer : peers())
        if (peer.name == technique) return peerContender(peer, setting, settings);
    for (const Contender& contender : gnomonContenders())
        if (contender.technique == technique && contender.setting == setting) return contender;
    throw std::invalid_argument("the chart has no " + technique + ", " + setting + ".");
}

/// Its work hangs on depths that nothing draws here: rays would start everywhere, the background too.
bool readsDepths(const Contender& contender) { return contender.technique == "traced"; }

json lineOf(const RaceResults& race) {
    const std::optional<ChartCost>& cost = race.contenders.front().cost;
    return cost ? json{race.frame, cost->steadyWall, cost->movingWall} : json();
}

} // namespace

void drawNothing() {
    setenv("GALLIUM_NOOP", "1", 1);   // before Mesa is there
    setenv("GALLIUM_THREAD", "0", 1); // with a thread for calls this driver crashes where a buffer grows
    const std::string renderer = HeadlessContext(16, 16).renderer();
    if (renderer.find("NOOP") == std::string::npos)
        throw std::runtime_error("OpenGL is " + renderer +
                                 ", which draws in spite of GALLIUM_NOOP. Needed is Mesa, by OSMesa or by EGL.");
}

std::vector<std::optional<AloneTimes>> timesAlone(const AlonePlan& plan, const std::vector<Contender>& contenders,
                                                  const std::function<bool()>& goesOn) {
    std::vector<std::optional<AloneTimes>> times;
    const auto hears = [&](const std::string& line) {
        if (const std::string text = after(answer, line); !text.empty()) times.push_back(timesOf(text));
        return goesOn();
    };
    while (times.size() < contenders.size()) {
        const Ending ending = runCommand(commandOf(plan, contenders, times.size()), hears);
        if (times.size() == contenders.size() || !goesOn()) break;
        if (ending.isRefusal()) throw std::runtime_error(after("gnomonchart: ", ending.said));
        times.emplace_back(); // its process has ended
    }
    return times;
}

void answerAlone(const std::string& request, const std::function<ChartScene(const std::string& name)>& scene,
                 const std::function<bool()>& stops) {
    std::signal(SIGPIPE, SIG_IGN); // who does not listen any more ends this by that
    const ShaderCache shaders;
    drawNothing();
    const json asked = json::parse(request);
    const ChartScene drawn = scene(asked.at("scene"));
    const auto goesOn = [&](int, int) { return !stops() && std::cout.good(); };
    for (const json& each : asked.at("contenders")) {
        const Contender contender = contenderOf(each.at(0), each.at(1), each.at(2));
        json line;
        if (!readsDepths(contender)) line = lineOf(race(drawn, {contender}, asked.at("frames"), shaders, goesOn));
        if (!goesOn(0, 0)) return;
        std::cout << answer << line.dump() << std::endl;
    }
}

} // namespace gnomon::examples
