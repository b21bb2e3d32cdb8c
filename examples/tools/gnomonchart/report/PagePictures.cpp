// SPDX-License-Identifier: MIT
#include "PagePictures.h"

#include "InputFile.h"
#include "OutputFile.h"

#include <osgDB/Registry>

#include <filesystem>
#include <sstream>

namespace gnomon::examples {
namespace {

namespace fs = std::filesystem;

/// The bytes of a PNG file; empty if it is none.
std::string pngBytes(const fs::path& file) {
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) return "";
    const std::string bytes = fileBytes(file).value_or("");
    return bytes.compare(0, 8, "\x89PNG\r\n\x1a\n") == 0 ? bytes : "";
}

/// A PNG at half its size each way; itself if that fails.
std::string halved(const std::string& png) {
    osgDB::ReaderWriter* reader = osgDB::Registry::instance()->getReaderWriterForExtension("png");
    std::istringstream in(png);
    const osg::ref_ptr<osg::Image> image = reader ? reader->readImage(in).getImage() : nullptr;
    if (!image || image->s() < 2 || image->t() < 2) return png;
    image->scaleImage(image->s() / 2, image->t() / 2, 1);
    const std::string smaller = imageBytes(*image, "png");
    return smaller.empty() ? png : smaller;
}

} // namespace

PagePictures::PagePictures(const std::string& folder, std::size_t mostBytes) : _folder(folder), _most(mostBytes) {}

nlohmann::json PagePictures::add(const std::string& name) {
    const auto known = _numbers.find(name);
    if (known != _numbers.end()) return known->second;
    const std::string png = name.empty() ? "" : pngBytes(fs::path(_folder) / name);
    if (png.empty()) return nullptr;
    _pngs.push_back(png);
    return _numbers[name] = _pngs.size() - 1;
}

std::size_t PagePictures::bytes() const {
    std::size_t sum = 0;
    for (const std::string& png : _pngs) sum += png.size();
    return sum;
}

void PagePictures::shrink() {
    for (std::string& png : _pngs) png = halved(png);
    _shrunk *= 2;
}

nlohmann::json PagePictures::json() {
    while (bytes() > _most && _shrunk < 8) shrink();
    nlohmann::json list = nlohmann::json::array();
    for (const std::string& png : _pngs) list.push_back("data:image/png;base64," + base64(png));
    return list;
}

std::string base64(const std::string& bytes) {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) {
            return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u;
        };
        const unsigned three = byte(0) << 16 | byte(1) << 8 | byte(2);
        for (unsigned k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
    }
    return text;
}

} // namespace gnomon::examples
