// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Image>

#include <filesystem>
#include <string>

namespace gnomon::examples {

/// A picture as a file of this ending ("png") holds it; empty if OSG has no writer for it.
std::string imageBytes(const osg::Image& image, const std::string& ending);

/// Sees that a folder is there, and makes it if it is not. @throws std::runtime_error, one sentence, if it cannot.
void requireFolder(const std::filesystem::path& folder);

/// Notes a file that this process reads: no OutputFile writes over it from now on.
void noteInput(const std::string& file);

/// A file that appears whole or not at all: written beside its place under another name, then renamed.
class OutputFile {
public:
    /// Sees that the file can be written before any work is done for it. What is read later is looked at again in write().
    /// @throws std::runtime_error, one sentence, if it cannot.
    explicit OutputFile(const std::string& path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// @throws std::runtime_error if the ending is a scene's, or OSG has no writer for images of it. Writes nothing that stays.
    void requireImage() const;
    /// @throws std::runtime_error if the file's kind does not keep an image's layers and names: .osgb, .osgt and .osgx do.
    void requireData() const;
    /// Colours of an image of bytes, RGB or RGBA.
    /// @throws std::runtime_error if not all of it could be written, or the program has read the file.
    void write(const osg::Image& image);
    void write(const std::string& text);
    /// An image with all that it holds. Needs requireData().
    void writeData(const osg::Image& image);

private:
    void finish();
    void removeDraft() const;

    std::filesystem::path _path;
    std::filesystem::path _draft;
};

} // namespace gnomon::examples
