// SPDX-License-Identifier: MIT
#include <gnomon/TracedCasters.h>

#include <OpenThreads/ScopedLock>
#include <osg/Timer>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <glm/vec3.hpp>
#include <unistd.h>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

/// A line on the terminal that grows while something takes longer than a second, and is gone at the end.
class Progress {
public:
    Progress(std::string name, unsigned triangles)
        : _what("gnomon: " + name + " builds a tree of " + std::to_string(triangles) + " triangles"),
          _terminal(isatty(STDERR_FILENO) != 0) {}
    ~Progress() {
        if (_shown >= 0) std::fprintf(stderr, "\r%*s\r", int(_what.size()) + 8, "");
    }

    /// May be called from several threads at once.
    void show(double share) {
        const int percent = static_cast<int>(100.0 * share);
        if (!_terminal || _watch.elapsedTime() < 1.0 || percent <= _shown.exchange(percent)) return;
        std::fprintf(stderr, "\r%s: %d %%", _what.c_str(), percent);
    }

private:
    const std::string _what;
    const bool _terminal;
    const osg::ElapsedTime _watch;
    std::atomic<int> _shown{-1};
};

/// About the mesh's origin. osg::Vec3 and glm::vec3 are three floats each.
TriangleSoup soupOf(const CasterMesh& mesh) {
    static_assert(sizeof(osg::Vec3) == sizeof(glm::vec3));
    TriangleSoup soup;
    soup.vertices = static_cast<const glm::vec3*>(mesh.vertices->getDataPointer());
    soup.vertexCount = mesh.vertices->size();
    soup.indices = mesh.triangles->empty() ? nullptr : &mesh.triangles->front();
    soup.indexCount = mesh.triangles->size();
    return soup;
}

std::shared_ptr<const RayScene> build(const CasterMesh& mesh, const std::string& name) {
    Progress progress(name, static_cast<unsigned>(mesh.triangles->size() / 3));
    return std::make_shared<RayScene>(soupOf(mesh), [&progress](double share) { progress.show(share); });
}

} // namespace

std::shared_ptr<const RayScene> TracedCasters::of(const CasterMesh& mesh, const std::string& name) {
    Lock lock(_mutex);
    const auto found =
        std::find_if(_entries.begin(), _entries.end(), [&](const Entry& entry) { return entry.mesh == &mesh; });
    if (found != _entries.end()) {
        std::rotate(found, found + 1, _entries.end());
        return _entries.back().scene;
    }
    if (_entries.size() > 1) _entries.erase(_entries.begin()); // before building, for both would be in memory
    _entries.push_back({&mesh, build(mesh, name)});
    ++_builds;
    return _entries.back().scene;
}

unsigned TracedCasters::builds() const {
    Lock lock(_mutex);
    return _builds;
}

} // namespace gnomon
