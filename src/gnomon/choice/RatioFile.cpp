// SPDX-License-Identifier: MIT
#include <gnomon/choice/RatioFile.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

namespace gnomon {
namespace {

namespace fs = std::filesystem;

constexpr const char* kind = "gnomon cost ratios 1";
constexpr std::uintmax_t mostBytes = 65536; // no file of ours is as long

/// FNV-1a: the same in every run.
std::string hashOf(const std::string& text) {
    std::uint64_t hash = 14695981039346656037u;
    for (const char letter : text) hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211u;
    std::ostringstream out;
    out << std::hex << hash;
    return out.str();
}

std::string oneLine(std::string text) {
    for (char& letter : text)
        if (letter == '\n' || letter == '\r') letter = ' ';
    return text;
}

std::optional<fs::path> absolutePath(const char* variable) {
    const char* value = std::getenv(variable);
    if (!value || !fs::path(value).is_absolute()) return std::nullopt;
    return fs::path(value);
}

/// Another one for each process and thread, so that two that write do not meet.
fs::path scratchFor(const fs::path& path) {
    std::ostringstream name;
    name << path.string() << '.' << std::this_thread::get_id() << '.' << std::hex
         << reinterpret_cast<std::uintptr_t>(&name) << ".new";
    return name.str();
}

} // namespace

std::optional<fs::path> userCache() {
    if (const auto cache = absolutePath("XDG_CACHE_HOME")) return *cache / "gnomon";
    if (const auto home = absolutePath("HOME")) return *home / ".cache" / "gnomon";
    return std::nullopt;
}

RatioFile::RatioFile(const fs::path& folder, const std::string& renderer)
    : _folder(folder),
      _path(folder / ("costs-" + hashOf(renderer) + ".txt")),
      _head(std::string(kind) + '\n' + oneLine(renderer) + '\n') {}

RatioFile::Read RatioFile::read() const {
    std::error_code error;
    if (fs::status(_path, error).type() == fs::file_type::not_found) return {};
    const std::string trouble =
        "\"" + _path.string() +
        "\" cannot be read as measured costs, so they are measured anew. Delete it if this comes again.";
    const std::uintmax_t size = fs::is_regular_file(_path, error) ? fs::file_size(_path, error) : 0;
    if (error || size == 0 || size > mostBytes) return {std::nullopt, trouble};
    std::ifstream in(_path, std::ios::binary);
    std::ostringstream all;
    all << in.rdbuf();
    const std::string text = all.str();
    const auto ratios = text.rfind(_head, 0) == 0 ? CostRatios::parse(text.substr(_head.size())) : std::nullopt;
    return {ratios, ratios ? "" : trouble};
}

std::string RatioFile::write(const CostRatios& ratios) const {
    std::error_code error;
    fs::create_directories(_folder, error);
    const fs::path scratch = scratchFor(_path);
    std::ofstream out(scratch, std::ios::binary);
    out << _head << ratios.text();
    out.close();
    if (out) fs::rename(scratch, _path, error);
    if (out && !error) return {};
    fs::remove(scratch, error);
    return "\"" + _path.string() +
           "\" cannot be written, so the next program measures costs again. Let XDG_CACHE_HOME name a folder that can "
           "be "
           "written.";
}

} // namespace gnomon
