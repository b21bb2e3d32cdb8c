// SPDX-License-Identifier: MIT
#include "Machine.h"

#include <gnomon/HeadlessContext.h>

#include <osg/Version>

#include <ctime>
#include <fstream>
#include <thread>
#include <unistd.h>

namespace gnomon::examples {
namespace {

std::string utcNow() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

/// What stands behind the first ": " of the first line that begins so.
std::string lineOf(const char* file, const std::string& begins) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);)
        if (line.rfind(begins, 0) == 0) return line.substr(line.find(": ") + 2);
    return "unknown";
}

std::string memoryText() {
    const double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    return std::to_string(static_cast<long>(bytes / (1024.0 * 1024.0))) + " MiB";
}

} // namespace

std::vector<std::pair<std::string, std::string>> machineFacts() {
    return {{"date", utcNow()},
            {"gnomon", GNOMON_VERSION},
            {"OpenSceneGraph", osgGetVersion()},
            {"renderer", HeadlessContext(16, 16).renderer()},
            {"compiler", __VERSION__},
            {"processor", lineOf("/proc/cpuinfo", "model name")},
            {"cores", std::to_string(std::thread::hardware_concurrency())},
            {"memory", memoryText()}};
}

std::string machineLoad() {
    std::ifstream in("/proc/loadavg");
    std::string load;
    return in >> load ? load : "unknown";
}

} // namespace gnomon::examples
