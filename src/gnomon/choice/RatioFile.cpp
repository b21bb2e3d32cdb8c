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

constexpr const char* kind = "gnomon cost ratios 2";
constexpr const char *begin = "costs-", *ending = ".txt"; // of a file's name
constexpr std::uintmax_t mostBytes = 65536;               // no file of ours is as long

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

/// Empty if it is no file of ours, or cannot be read.
std::string textOf(const fs::path& path) {
    std::error_code error;
    const std::uintmax_t size = fs::is_regular_file(path, error) ? fs::file_size(path, error) : 0;
    if (error || size > mostBytes) return {};
    std::ifstream in(path, std::ios::binary);
    std::ostringstream all;
    all << in.rdbuf();
    return all.str();
}

/// In the text of a file of any renderer.
std::optional<CostRatios> ratiosIn(const std::string& text) {
    const std::size_t renderer = text.find('\n'), ratios = text.find('\n', renderer + 1);
    if (text.substr(0, renderer) != kind || renderer == text.npos || ratios == text.npos) return std::nullopt;
    return CostRatios::parse(text.substr(ratios + 1));
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
      _path(folder / (begin + hashOf(kind + renderer) + ending)),
      _head(std::string(kind) + '\n' + oneLine(renderer) + '\n') {}

RatioFile::Read RatioFile::read() const {
    std::error_code error;
    if (fs::status(_path, error).type() == fs::file_type::not_found) return {};
    const std::string text = textOf(_path);
    const auto ratios = text.rfind(_head, 0) == 0 ? CostRatios::parse(text.substr(_head.size())) : std::nullopt;
    if (ratios) return {ratios, ""};
    return {std::nullopt,
            "\"" + _path.string() +
                "\" cannot be read as measured costs, so they are measured anew. Delete it if this comes again."};
}

void RatioFile::touch() const {
    std::error_code ignored; // of a folder that cannot be written, another file may stay the last
    fs::last_write_time(_path, fs::file_time_type::clock::now(), ignored);
}

std::optional<CostRatios> RatioFile::usedLast(const fs::path& folder) {
    std::optional<CostRatios> last;
    fs::file_time_type when;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (name.rfind(begin, 0) != 0 || entry->path().extension() != ending) continue;
        std::error_code gone; // meanwhile
        const fs::file_time_type used = entry->last_write_time(gone);
        if (gone || (last && used <= when)) continue;
        if (const auto ratios = ratiosIn(textOf(entry->path()))) last = ratios, when = used;
    }
    return last;
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
