// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/OptionalParts.h>
#include <gnomon/RayScene.h>
#include <gnomon/ScreenPass.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gnomon/ViewFrame.h>
#include <gnomon/base/PixelRect.h>
#include <gnomon/casters/Casters.h>
#include <gnomon/casters/RaySceneCache.h>
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/geometry/DrawnError.h>
#include <gnomon/gl/FrameDepths.h>
#include <gnomon/gl/SavedFramebuffers.h>
#include <gnomon/group/PerView.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/rays/DepthBufferShadow.h>

#include <OpenThreads/Mutex>
#include <OpenThreads/ScopedLock>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <osg/State>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <tuple>
#include <unordered_set>
#include <utility>
#include <vector>

namespace gnomon {

/// What rays are cast for in one view and of one light.
struct TracedFrame {
    ViewKey view;
    int light = 0;      ///< number.
    unsigned frame = 0; ///< number.
    std::shared_ptr<const RayScene> scene;
    osg::ref_ptr<const Casters> pieces; ///< of the scene; null if they are not known.
    osg::Vec3d origin;                  ///< of the scene, group frame.
    glm::dmat4 clipFromScene{1.0};
    glm::dvec4 lightInScene{0.0};
    DepthPicture picture; ///< the depths of it.
    bool smooth = false;  ///< shares are wanted, too.
};

/// Where the light does not reach, as depthBufferShadow() has it; and what share of it arrives, where that is wanted.
struct TracedAnswer {
    std::vector<std::uint8_t> bits, shares;
};

/// The answers of a technique's last frames, so that rays are cast only where depth, light or casters have changed.
///
/// Cost
/// - Four bytes a pixel, five with shares, of each light in each view, until PerView lets it go.
/// Threads
/// - Any number.
class TracedFrames {
public:
    /// Casts rays only where they may differ from the last ones of the same view and light; for shares, wherever they are not all of
    /// the light or nothing, once any may.
    std::shared_ptr<const TracedAnswer> answerTo(TracedFrame frame);
    /// How many pixels rays were cast for so far.
    std::size_t traced() const { return _traced; }

private:
    /// A caster, for comparisons.
    struct Piece {
        std::uint64_t fingerprint;
        osg::BoundingBoxd bounds; ///< group frame.
    };
    using Pieces = std::vector<Piece>;
    struct Known {
        TracedFrame frame;                    ///< without scene and pieces, which may be large.
        std::weak_ptr<const RayScene> scene;  ///< of it.
        std::shared_ptr<const Pieces> pieces; ///< of it; null if they are not known.
        std::shared_ptr<const TracedAnswer> answer;
    };
    /// What is known of a light in a view. Whoever casts rays for it holds it, so that it may be let go meanwhile.
    struct Last {
        std::shared_ptr<const Known> known;
    };

    static std::shared_ptr<const Pieces> piecesOf(const Casters* casters);
    static bool addMissing(const Pieces& pieces, const Pieces& others, const osg::Vec3d& origin,
                           std::vector<RayBox>& boxes);
    static std::optional<std::vector<RayBox>> changesBetween(const Known& before, const Pieces* now,
                                                             const osg::Vec3d& origin);

    OpenThreads::Mutex _mutex;
    PerView<std::shared_ptr<Last>> _last;
    std::atomic<std::size_t> _traced{0};
};

namespace {

/// Marks of one light in one view: a ray to the light from where the depth buffer says a surface is.
class TracedMark : public Mark {
public:
    TracedFrame frame;                       ///< without the picture.
    std::shared_ptr<TracedFrames> frames;    ///< the technique's.
    std::shared_ptr<ResolvedDepth> resolved; ///< the technique's, for framebuffers with several samples.
    double rounding = 0.0;                   ///< of the casters' vertices.
    glm::dvec2 pushedBack{0.0};              ///< see ViewFrame.

    TracedMark() { depthSteps = 0.0; } ///< Rays find the surface within what a depth may mean.
    Kind kind() const override { return frame.smooth ? Kind::Fades : Kind::Hard; }
    std::string draw(ScreenPass& pass) const override;
    void look(ScreenPass& pass) const override { _looked = find(pass); }

protected:
    ~TracedMark() override = default;

private:
    struct Found {
        std::string cause;                          ///< why nothing was; empty if all is well.
        DepthPicture part;                          ///< without its depths.
        std::shared_ptr<const TracedAnswer> answer; ///< null if nothing is looked at.
    };
    Found find(const ScreenPass& pass) const;

    mutable std::optional<Found> _looked; ///< for the next draw().
};

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

constexpr std::size_t mostBoxes = 16; // of what has changed: a look at more costs as much as a ray

/// True if depths of both mean the same places, of the same pixels.
bool isSamePart(const DepthPicture& a, const DepthPicture& b) {
    const auto key = [](const DepthPicture& p) {
        return std::make_tuple(p.viewportWidth, p.viewportHeight, p.x, p.y, p.width, p.height, p.step, p.subpixel,
                               p.place.x, p.place.y, p.offPlace, p.neighbour, p.drawnPixels, p.drawnDepth);
    };
    return key(a) == key(b);
}

/// What the marks' bounds leave, at which the scissor stands.
DepthPicture partInScissor(const osg::Viewport& viewport) {
    const PixelRect pixels = pixelsInScissor(viewport), all = pixelsOf(viewport);
    DepthPicture part;
    part.viewportWidth = all.width;
    part.viewportHeight = all.height;
    part.x = pixels.x - all.x;
    part.y = pixels.y - all.y;
    part.width = pixels.width;
    part.height = pixels.height;
    return part;
}

/// @return false if this framebuffer's depth cannot be read.
bool readDepth(osg::State& state, ResolvedDepth& resolved, DepthPicture& part) {
    const PixelRect all = pixelsOf(*state.getCurrentViewport());
    const GLint x = part.x + all.x, y = part.y + all.y;
    part.depths.resize(std::size_t(part.width) * std::size_t(part.height));
    part.step = std::ldexp(1.0, -std::min(glInteger(GL_DEPTH_BITS), 24));
    part.subpixel = std::ldexp(1.0, -std::clamp(glInteger(GL_SUBPIXEL_BITS), 4, 16));
    const auto read = [&] {
        glReadPixels(x, y, part.width, part.height, GL_DEPTH_COMPONENT, GL_FLOAT, part.depths.data());
    };
    if (ResolvedDepth::isNeeded(state)) {
        const auto place = resolved.read(state, {x, y, part.width, part.height}, read);
        part.place = place.value_or(part.place);
        return place.has_value();
    }
    part.offPlace = glInteger(GL_SAMPLES) > 0 ? 0.5 : 0.0; // whichever sample a window's depth is
    read();
    return true;
}

/// The empty bitmap moves the raster position, which no place off the screen may set.
void beginPixels(osg::State& state, const DepthPicture& part) {
    state.applyProjectionMatrix(nullptr);
    state.applyModelViewMatrix(nullptr);
    glRasterPos2d(-1.0, -1.0);
    glBitmap(0, 0, 0.0f, 0.0f, static_cast<GLfloat>(part.x), static_cast<GLfloat>(part.y), nullptr);
}

/// A fragment where not all of the light arrives, with the share that does in alpha; or, where marks are to be hard, where less than
/// half of it does.
void drawShares(ScreenPass& pass, const DepthPicture& part, const std::vector<std::uint8_t>& shares) {
    beginPixels(pass.state(), part);
    glEnable(GL_ALPHA_TEST);
    glAlphaFunc(GL_LESS, pass.wanted() == ScreenPass::Want::Blocked ? 0.5f : 1.0f);
    glDrawPixels(part.width, part.height, GL_ALPHA, GL_UNSIGNED_BYTE, shares.data());
    glDisable(GL_ALPHA_TEST);
}

/// A fragment where a bit is set.
void drawBits(osg::State& state, const DepthPicture& part, const std::vector<std::uint8_t>& bits) {
    beginPixels(state, part);
    glBitmap(part.width, part.height, 0.0f, 0.0f, 0.0f, 0.0f, bits.data());
}

/// The same as rectangles, one for each run of bits in a row: of glBitmap Mesa's llvmpipe (22.3) takes one sample only.
void drawRuns(osg::State& state, const DepthPicture& part, const std::vector<std::uint8_t>& bits) {
    const osg::ref_ptr<osg::RefMatrix> pixels =
        new osg::RefMatrix(osg::Matrixd::ortho2D(0.0, part.viewportWidth, 0.0, part.viewportHeight));
    state.applyProjectionMatrix(pixels);
    state.applyModelViewMatrix(nullptr);
    const std::size_t stride = bits.size() / std::size_t(part.height);
    for (int y = 0; y < part.height; ++y) {
        const std::uint8_t* row = bits.data() + stride * std::size_t(y);
        const auto isSet = [row](int x) { return (row[x / 8] & (0x80 >> (x % 8))) != 0; };
        for (int x = 0, first = 0; x < part.width; first = x) {
            const bool set = isSet(first);
            while (x < part.width && isSet(x) == set) ++x;
            if (set) glRecti(part.x + first, part.y + y, part.x + x, part.y + y + 1);
        }
    }
}

} // namespace

std::shared_ptr<const TracedFrames::Pieces> TracedFrames::piecesOf(const Casters* casters) {
    if (!casters) return nullptr;
    auto pieces = std::make_shared<Pieces>();
    pieces->reserve(casters->list.size());
    for (const auto& piece : casters->list) pieces->push_back({piece->fingerprint, piece->bounds});
    return pieces;
}

/// Adds the boxes of those that others lack. @return false if there are too many.
bool TracedFrames::addMissing(const Pieces& pieces, const Pieces& others, const osg::Vec3d& origin,
                              std::vector<RayBox>& boxes) {
    std::unordered_set<std::uint64_t> known;
    for (const Piece& piece : others) known.insert(piece.fingerprint);
    for (const Piece& piece : pieces) {
        if (known.count(piece.fingerprint) > 0 || !piece.bounds.valid()) continue;
        if (boxes.size() == mostBoxes) return false;
        boxes.push_back({toGlm(piece.bounds._min - origin), toGlm(piece.bounds._max - origin)});
    }
    return true;
}

/// Where what casts differs; nullopt if that may be anywhere.
std::optional<std::vector<RayBox>> TracedFrames::changesBetween(const Known& before, const Pieces* now,
                                                                const osg::Vec3d& origin) {
    std::vector<RayBox> boxes;
    const bool comparable = before.pieces && now && before.frame.origin == origin;
    if (!comparable || !addMissing(*before.pieces, *now, origin, boxes) ||
        !addMissing(*now, *before.pieces, origin, boxes))
        return std::nullopt;
    return boxes;
}

std::shared_ptr<const TracedAnswer> TracedFrames::answerTo(TracedFrame frame) {
    std::shared_ptr<Last> last;
    std::shared_ptr<const Known> before;
    {
        Lock lock(_mutex);
        std::shared_ptr<Last>& known = _last.of(frame.view, frame.light, frame.frame);
        if (!known) known = std::make_shared<Last>();
        last = known;
        before = last->known;
    }
    const bool sameScene = before && before->scene.lock() == frame.scene;
    const auto pieces = sameScene ? before->pieces : piecesOf(frame.pieces.get());
    frame.pieces = nullptr;
    std::optional<std::vector<RayBox>> changed;
    if (before && before->frame.clipFromScene == frame.clipFromScene &&
        before->frame.lightInScene == frame.lightInScene && isSamePart(before->frame.picture, frame.picture))
        changed = sameScene ? std::vector<RayBox>() : changesBetween(*before, pieces.get(), frame.origin);
    std::optional<FormerShadow> former;
    if (changed) former.emplace(FormerShadow{before->frame.picture, before->answer->bits, std::move(*changed)});
    const std::shared_ptr<const RayScene> scene = std::move(frame.scene);
    std::shared_ptr<const TracedAnswer> answer;
    if (former && former->changed.empty() && frame.picture.depths == former->picture.depths &&
        (!frame.smooth || !before->answer->shares.empty()))
        answer = before->answer;
    else {
        TracedBits found = depthBufferShadow(*scene, frame.picture, frame.clipFromScene, frame.lightInScene,
                                             former ? &*former : nullptr);
        _traced += found.traced;
        TracedAnswer fresh{std::move(found.bits), {}};
        if (frame.smooth)
            fresh.shares =
                depthBufferShares(*scene, frame.picture, frame.clipFromScene, frame.lightInScene, fresh.bits);
        answer = std::make_shared<const TracedAnswer>(std::move(fresh));
    }
    auto now = std::make_shared<const Known>(Known{std::move(frame), scene, pieces, answer});
    Lock lock(_mutex);
    last->known.swap(now);
    return answer;
}

/// Of the frame that is drawn to.
TracedMark::Found TracedMark::find(const ScreenPass& pass) const {
    osg::State& state = pass.state();
    if (glInteger(GL_DEPTH_BITS) == 0) return {noDepth, {}, {}};
    const PlainPixels plain(state);
    DepthPicture part = partInScissor(*state.getCurrentViewport());
    if (part.width <= 0 || part.height <= 0) return {"", part, {}};
    if (!readDepth(state, *resolved, part)) return {unresolvedDepth, {}, {}};
    if (pass.isInterlaced()) part.neighbour = 2;
    part.offPlace += pushedBack.x;
    part.step *= 1.0 + pushedBack.y; // of which depthBufferShadow() allows for a few
    const DrawnError drawn = drawnError(frame.clipFromScene, toGlm(state.getProjectionMatrix()), part.viewportWidth,
                                        rounding, frame.scene->longestSide());
    part.drawnDepth = drawn.depth;
    part.drawnPixels = drawn.pixels;
    TracedFrame seen = frame;
    std::vector<float> depths;
    depths.swap(part.depths);
    seen.picture = part;
    seen.picture.depths.swap(depths);
    return {"", part, frames->answerTo(std::move(seen))};
}

std::string TracedMark::draw(ScreenPass& pass) const {
    const Found found = _looked ? std::move(*_looked) : find(pass);
    _looked.reset();
    if (!found.cause.empty() || found.part.width <= 0 || found.part.height <= 0) return found.cause;
    const PlainPixels plain(pass.state());
    if (frame.smooth)
        drawShares(pass, found.part, found.answer->shares);
    else
        (glInteger(GL_SAMPLES) > 0 ? drawRuns : drawBits)(pass.state(), found.part, found.answer->bits);
    return "";
}

TracedShadowTechnique::TracedShadowTechnique()
    : _casters(new RaySceneCache), _resolved(new ResolvedDepth), _frames(new TracedFrames) {}

TracedShadowTechnique::TracedShadowTechnique(const TracedShadowTechnique& other, const osg::CopyOp& copyOp)
    : ShadowTechnique(other, copyOp),
      _options(other._options),
      _casters(new RaySceneCache),
      _resolved(new ResolvedDepth),
      _frames(new TracedFrames) {}

TracedShadowTechnique::~TracedShadowTechnique() = default;

std::vector<osg::ref_ptr<Mark>> TracedShadowTechnique::prepare(const ViewFrame& view, const ShadowLight& light,
                                                               const Casters& casters) const {
    const CasterLayers& layers = casters.layers();
    const SceneFrame scene(layers.origin);
    const auto usable = lightInScene(light.inGroup, scene);
    if (!usable) {
        report(view.frameNumber, notUsable(light.inGroup));
        return {};
    }
    osg::ref_ptr<TracedMark> mark = new TracedMark;
    mark->frame.lightInScene = *usable;
    mark->frame.light = light.number;
    mark->frame.view = view.key;
    mark->frame.frame = view.frameNumber;
    mark->frame.origin = layers.origin;
    mark->frame.pieces = &casters;
    mark->frame.smooth = _options.edges == SMOOTH;
    mark->frames = _frames;
    mark->resolved = _resolved;
    mark->rounding = layers.largestRounding;
    mark->frame.clipFromScene = scene.clipFromScene(view);
    mark->pushedBack = {view.pushedBack.x(), view.pushedBack.y()};
    const auto bounds = shadowBounds(layers, mark->frame.clipFromScene, *usable);
    if (!bounds) return {}; // out of sight: nothing to say
    mark->screenBounds = *bounds;
    try {
        mark->frame.scene = _casters->of(casters, describe());
    } catch (const std::exception& failure) {
        report(view.frameNumber, std::string("there is no shadow. ") + failure.what());
        return {};
    }
    return {mark};
}

std::string TracedShadowTechnique::whyUnavailable() const { return whyMissing(OptionalPart::Traced); }

unsigned TracedShadowTechnique::builds() const { return _casters->builds(); }

std::size_t tracedPixels(const TracedShadowTechnique& technique) { return technique._frames->traced(); }

void TracedShadowTechnique::releaseGLObjects(osg::State* state) const {
    ShadowTechnique::releaseGLObjects(state);
    _resolved->release(state);
}

} // namespace gnomon
