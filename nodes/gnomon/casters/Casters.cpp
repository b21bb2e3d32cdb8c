// SPDX-License-Identifier: MIT
#include <gnomon/base/Fingerprint.h>
#include <gnomon/casters/CasterExtraction.h>
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/casters/CasterVisitor.h>
#include <gnomon/casters/Casters.h>
#include <gnomon/casters/DrawableTriangles.h>
#include <gnomon/casters/KnownCasters.h>

#include <osg/GraphicsContext>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace gnomon {
namespace {

/// Where a drawable's triangles are, without them.
class DrawableBounds : public TriangleDecoder {
public:
    using TriangleDecoder::TriangleDecoder;
    ~DrawableBounds() override = default;

    osg::BoundingBoxd bounds;
    std::size_t triangles = 0;
    bool anyInvalid = false; ///< that is left out.

protected:
    void start(unsigned) override {}
    void point(unsigned) override {}
    void triangle(unsigned a, unsigned b, unsigned c) override {
        osg::BoundingBoxd box = bounds;
        for (const unsigned index : {a, b, c}) {
            const osg::Vec3d place = isInArray(index) ? inRoot(local(index)) : osg::Vec3d(NAN, NAN, NAN);
            anyInvalid = anyInvalid || !isUsable(place);
            if (!isUsable(place)) return;
            box.expandBy(place);
        }
        bounds = box;
        ++triangles;
    }
};

/// Reads pieces where they are, without the nodes above them.
class DrawableReader : public CasterExtraction {
public:
    void read(const Caster& piece) {
        if (piece.kept) return append(*piece.kept);
        _piece = &piece;
        setRootFromVisited(piece.groupFromLocal);
        const_cast<osg::Drawable&>(*piece.drawable).accept(*this); // which changes nothing
    }

protected:
    Casting castingOf(const osg::Drawable&) override { return _piece->casting; }
    Hiding hiding() const override { return _piece->hiding; }

private:
    const Caster* _piece = nullptr;
};

/// Meets casters, and knows those again that it is told of.
class DrawableVisitor : public CasterVisitor {
public:
    DrawableVisitor(const Selection& casters, const Casters* before, const KnownCasters* known)
        : CasterVisitor(casters),
          _before(before ? before->list : _none),
          _selfDrawingsBefore(before ? before->selfDrawings : Casters::SelfDrawings()),
          _leftOutBefore(before ? before->leftOut : std::string()),
          _known(known) {}

    bool changed() const {
        return _changed || _same != _before.size() || _selfDrawings != _selfDrawingsBefore ||
               leftOut() != _leftOutBefore;
    }
    std::uint64_t fingerprint() const { return _fingerprint.value(); }
    /// Those that were met.
    CasterList take() {
        startSelfDrawings();
        return std::move(_met);
    }
    Casters::SelfDrawings takeSelfDrawings() { return std::move(_selfDrawings); }

protected:
    void applyCaster(osg::Drawable& drawable, const Casting& casting) override {
        const std::uint64_t geometry = CasterFingerprint::ofGeometry(drawable, casting, contents(drawable, casting));
        Fingerprint placed;
        placed.mix(CasterFingerprint::placed(geometry, placeValue()));
        if (const osg::Texture2D* texture = casting.test ? casting.test->texture.get() : nullptr)
            if (texture->getUnRefImageDataAfterApply()) placed.mix(static_cast<const void*>(alphasOf(*texture).get()));
        placed.mix(static_cast<std::uint64_t>(hiding()));
        const std::uint64_t value = placed.value();
        _fingerprint.mix(value);
        const Caster& piece = pieceOf(drawable, casting, geometry, value);
        if (piece.selfDrawn && !drawsItself(drawable)) addSelfDrawing(drawable, casting, value);
    }

    void applySelfDrawing(osg::Drawable& drawable, const Casting& casting) override {
        const std::uint64_t contents = followsOf(drawable) == Follows::Each ? contentsOf(drawable, true) : 0;
        const std::uint64_t geometry = CasterFingerprint::ofGeometry(drawable, casting, contents);
        addSelfDrawing(drawable, casting, CasterFingerprint::placed(geometry, placeValue()));
    }

private:
    /// In the old order as a rule. Of what hands out no triangles, a list that is released counts as changed.
    void addSelfDrawing(const osg::Drawable& drawable, const Casting& casting, std::uint64_t placed) {
        const std::size_t place = _selfDrawings.size();
        const SelfDrawing* before = place < _selfDrawingsBefore.size() ? _selfDrawingsBefore[place].get() : nullptr;
        if (before && before->drawable != &drawable) before = nullptr;
        unsigned edition = before ? before->edition : 0;
        const bool isListed = before && !before->hasPiece && followsOf(drawable) == Follows::List;
        if ((isListed && before->list.mayBeStale(drawable, _contexts)) || (before && before->images.haveOther()))
            ++edition;
        Fingerprint value;
        value.mix(SelfDrawing::fingerprintOf(drawable, placed, statesNow()));
        value.mix(std::uint64_t{edition});
        _fingerprint.mix(value.value());
        if (before && before->fingerprint == value.value()) return _selfDrawings.push_back(_selfDrawingsBefore[place]);
        const osg::ref_ptr<SelfDrawing> made = new SelfDrawing(getNodePath(), drawable, rootFromLocal(), casting);
        made->fingerprint = value.value();
        made->edition = edition;
        if (before) made->list = before->list;
        _selfDrawings.push_back(made);
    }

    /// Found once for drawables that follow each other under the same sets.
    std::uint64_t statesNow() {
        DrawnStates states = SelfDrawing::statesAlong(getNodePath());
        if (_statesValue == 0 || states != _states) {
            Fingerprint value;
            mixStates(states, value);
            _states = std::move(states);
            _statesValue = value.value();
        }
        return _statesValue;
    }

    /// Of a drawable with a list, as the piece has them that was made of it, until the list is released. Where that piece
    /// is not the next one they are read again.
    std::uint64_t contents(const osg::Drawable& drawable, const Casting& casting) {
        const Follows follows = followsOf(drawable);
        if (follows == Follows::Counts) return _contents = 0;
        const Caster* before = _next < _before.size() ? _before[_next].get() : nullptr;
        if (before && before->drawable != &drawable) before = nullptr;
        if (follows == Follows::List && before && !before->list.mayBeStale(drawable, _contexts))
            return _contents = before->contents;
        const auto [read, isNew] = _read.try_emplace(&drawable);
        if (isNew) read->second = contentsOf(drawable, casting.looksAtAll());
        return _contents = read->second;
    }

    const Caster& pieceOf(osg::Drawable& drawable, const Casting& casting, std::uint64_t geometry,
                          std::uint64_t value) {
        if (!_changed && isAt(_next, value)) {
            ++_same;
            return *_before[_next++];
        }
        startSelfDrawings();
        osg::ref_ptr<const Caster> piece = find(value);
        if (!piece && _known && isOfLevels()) piece = _known->find(value);
        if (!piece) piece = make(drawable, value, geometry, casting);
        _met.push_back(piece);
        return *piece;
    }

    bool isAt(std::size_t place, std::uint64_t value) const {
        return place < _before.size() && _before[place]->fingerprint == value;
    }

    /// Nothing is copied as long as nothing differs.
    void startSelfDrawings() {
        if (!_changed) _met.assign(_before.begin(), _before.begin() + static_cast<std::ptrdiff_t>(_same));
        _changed = true;
    }

    /// In the old order as a rule. One that differs has changed in place, unless the one after it is met: then it is gone. If
    /// two differ, any may be anywhere.
    const Caster* find(std::uint64_t value) {
        if (!isAt(_next, value) && isAt(_next + 1, value)) ++_next;
        if (!isAt(_next, value)) {
            const std::size_t place = _missed ? placeOf(value) : _before.size();
            if (place == _before.size()) {
                ++_next;
                _missed = true;
                return nullptr;
            }
            _next = place;
        }
        _missed = false;
        return _before[_next++].get();
    }

    std::size_t placeOf(std::uint64_t value) {
        if (_places.empty())
            for (std::size_t i = 0; i < _before.size(); ++i) _places.emplace(_before[i]->fingerprint, i);
        const auto found = _places.find(value);
        return found == _places.end() ? _before.size() : found->second;
    }

    osg::ref_ptr<const Caster> make(osg::Drawable& drawable, std::uint64_t fingerprint, std::uint64_t geometry,
                                    const Casting& casting) {
        osg::ref_ptr<Caster> piece = new Caster;
        piece->fingerprint = fingerprint;
        piece->geometry = geometry;
        piece->contents = _contents;
        piece->drawable = &drawable;
        piece->groupFromLocal = rootFromLocal();
        piece->hiding = hiding();
        piece->casting = casting;
        piece->ofLevels = isOfLevels();
        if (casting.test && casting.test->texture)
            piece->casting.test->alphas = piece->alphas = alphasOf(*casting.test->texture);
        if (_known && casting.clips.empty())
            piece->bounds = _known->boundsOf(geometry, rootFromLocal(), piece->triangles);
        const bool isKnown = piece->bounds.valid(); // as a body, which has all its triangles
        if (isKnown) piece->casting.test.reset();
        DrawableBounds found(rootFromLocal());
        if (!isKnown && !isOfLevels() && casting.isWhole()) {
            found.setRestart(casting.restart);
            readTriangles(drawable, found);
            piece->triangles = found.triangles;
            piece->bounds = found.bounds;
        }
        holdSources(drawable, piece->sources);
        casting.hold(drawable, piece->sources);
        if (!isKnown && (isOfLevels() || !casting.isWhole() || found.anyInvalid)) describe(*piece);
        const bool isAny = piece->triangles > 0 || casting.makesTriangles ||
                           (casting.moved && drawable.asGeometry() && drawsTriangles(*drawable.asGeometry()));
        if (!casting.test && casting.selfDrawn && isAny) {
            piece->cutOut = piece->selfDrawn = true;
            piece->cutoutNode = nameAlong(getNodePath());
        }
        if (casting.byPixel) piece->cutoutNode = nameAlong(getNodePath());
        return piece;
    }

    /// What is missing of it. Under an LOD it keeps all that is not.
    void describe(Caster& piece) const {
        const osg::ref_ptr<DrawableReader> found = new DrawableReader;
        for (osg::Node* node : getNodePath()) found->pushOntoNodePath(node); // for the names in it
        found->read(piece);
        found->trim();
        piece.invalidTriangles = found->getInvalidTriangles();
        piece.invalidNode = found->getInvalidNode();
        piece.cutOut = !found->getCutouts().empty();
        piece.selfDrawn = piece.cutOut && found->getCutouts().front().selfDrawn;
        piece.cutoutNode = found->getCutoutNode();
        piece.triangles = found->getTriangles().size() / 3;
        piece.bounds.init();
        for (const unsigned index : found->getTriangles()) piece.bounds.expandBy(found->getVertices()[index]);
        if (!piece.cutOut && found->getClearTriangles() == 0) piece.casting.test.reset();
        if (isOfLevels() && !isBody(piece)) piece.kept = found;
    }

    /// Of a texture once a visit: as a piece that was made before has them, until the texture has another image.
    osg::ref_ptr<const TextureAlpha> alphasOf(const osg::Texture2D& texture) {
        const auto [known, isNew] = _alphas.try_emplace(&texture);
        if (!isNew) return known->second;
        const auto hasThem = [&texture](const auto& piece) { return piece->alphas && piece->alphas->isOf(texture); };
        auto piece = _before.begin() + static_cast<std::ptrdiff_t>(std::min(_next, _before.size()));
        if (piece == _before.end() || !hasThem(*piece)) piece = std::find_if(_before.begin(), _before.end(), hasThem);
        known->second = piece != _before.end() ? (*piece)->alphas : TextureAlpha::of(texture);
        return known->second;
    }

    const CasterList _none, &_before;
    const Casters::SelfDrawings _selfDrawingsBefore;
    const std::string _leftOutBefore;
    Casters::SelfDrawings _selfDrawings;
    const KnownCasters* const _known;
    CasterList _met;
    std::unordered_map<std::uint64_t, std::size_t> _places;
    std::unordered_map<const osg::Texture2D*, osg::ref_ptr<const TextureAlpha>> _alphas;
    std::unordered_map<const osg::Drawable*, std::uint64_t> _read; ///< contents, however often a drawable is met.
    const unsigned _contexts = osg::GraphicsContext::getMaxContextID() + 1;
    std::uint64_t _contents = 0; ///< of the drawable being visited.
    DrawnStates _states;
    std::uint64_t _statesValue = 0; ///< of these; 0: of none yet.
    std::size_t _same = 0, _next = 0;
    bool _changed = false, _missed = false;
    Fingerprint _fingerprint;
};

osg::BoundingBoxd common(const osg::BoundingBoxd& a, const osg::BoundingBoxd& b) { return a.intersect(b); }

/// Of each piece the bounds of what it has in common with others' bounds; invalid if that is nothing.
std::vector<osg::BoundingBoxd> seamsOf(const CasterList& pieces) {
    std::vector<std::size_t> order(pieces.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return pieces[a]->bounds.xMin() < pieces[b]->bounds.xMin(); });
    std::vector<osg::BoundingBoxd> seams(pieces.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const osg::BoundingBoxd& box = pieces[order[i]]->bounds;
        for (std::size_t k = i + 1; k < order.size() && pieces[order[k]]->bounds.xMin() <= box.xMax(); ++k) {
            const osg::BoundingBoxd& other = pieces[order[k]]->bounds;
            if (!touch(box, other)) continue;
            seams[order[i]].expandBy(common(box, other));
            seams[order[k]].expandBy(common(box, other));
        }
    }
    return seams;
}

/// A vertex's place, and whose it is.
struct Corner {
    std::uint64_t place;
    std::size_t piece;
    bool operator<(const Corner& other) const { return place < other.place; }
};

void addCorners(const Caster& piece, const osg::BoundingBoxd& within, std::size_t index, std::vector<Corner>& corners) {
    CasterExtraction read;
    read.setRootFromVisited(piece.groupFromLocal);
    if (!piece.kept) const_cast<osg::Drawable&>(*piece.drawable).accept(read); // which changes nothing
    for (const osg::Vec3d& vertex : (piece.kept ? *piece.kept : read).getVertices()) {
        if (!within.contains(vertex)) continue;
        Fingerprint place;
        for (int i = 0; i < 3; ++i) place.mix(vertex[i] + 0.0); // -0 and 0 are one place
        corners.push_back({place.value(), index});
    }
}

std::size_t rootOf(std::vector<std::size_t>& above, std::size_t piece) {
    while (above[piece] != piece) piece = above[piece] = above[above[piece]];
    return piece;
}

} // namespace

Casters::Casters(CasterList pieces, std::uint64_t fingerprintOfAll, std::uint64_t choiceOfAll, SelfDrawings drawings,
                 std::string leftOutOfAll)
    : list(std::move(pieces)),
      selfDrawings(std::move(drawings)),
      fingerprint(fingerprintOfAll),
      choice(choiceOfAll),
      leftOut(std::move(leftOutOfAll)) {
    for (const auto& piece : list) {
        bounds.expandBy(piece->bounds);
        if (invalidTriangles == 0) invalidNode = piece->invalidNode;
        invalidTriangles += piece->invalidTriangles;
        if (cutouts == 0) cutoutNode = piece->cutoutNode;
        const bool isCut = piece->cutOut && !piece->casting.moved;
        cutouts += isCut;
        const bool isKnown = !piece->selfDrawn && piece->casting.test && piece->casting.test->isKnown();
        if (isCut && !isKnown && drawnCutouts++ == 0) drawnCutoutNode = piece->cutoutNode;
        if (piece->casting.byPixel && screenDoors++ == 0) screenDoorNode = piece->cutoutNode;
    }
}

osg::ref_ptr<const Casters> Casters::of(osg::Node& root, const Selection& casters,
                                        const osg::ref_ptr<const Casters>& before, const CasterView* view,
                                        KnownCasters* known, const CastingRule& rule) {
    DrawableVisitor visitor(casters, before.get(), known);
    visitor.setRule(rule);
    if (view) visitor.setView(*view);
    if (known) known->startVisit();
    root.accept(visitor);
    if (before && !visitor.changed()) return before;
    const osg::ref_ptr<Casters> met = new Casters(visitor.take(), visitor.fingerprint(), visitor.choice(),
                                                  visitor.takeSelfDrawings(), visitor.leftOut());
    for (const auto& piece : met->list)
        if (known && piece->ofLevels) known->add(*piece);
    return met;
}

osg::ref_ptr<CasterMesh> meshOf(const CasterList& pieces, const std::optional<osg::Vec3d>& origin) {
    DrawableReader all;
    for (const auto& piece : pieces) all.read(*piece);
    return new CasterMesh(all, origin);
}

std::vector<std::size_t> weldedCasters(const CasterList& pieces) {
    const std::vector<osg::BoundingBoxd> seams = seamsOf(pieces);
    std::vector<Corner> corners;
    for (std::size_t i = 0; i < pieces.size(); ++i)
        if (seams[i].valid()) addCorners(*pieces[i], seams[i], i, corners);
    std::sort(corners.begin(), corners.end());
    std::vector<std::size_t> above(pieces.size());
    std::iota(above.begin(), above.end(), std::size_t{0});
    for (std::size_t i = 1; i < corners.size(); ++i) {
        if (corners[i].place != corners[i - 1].place) continue;
        const std::size_t a = rootOf(above, corners[i - 1].piece), b = rootOf(above, corners[i].piece);
        above[std::max(a, b)] = std::min(a, b);
    }
    for (std::size_t i = 0; i < above.size(); ++i) above[i] = rootOf(above, i);
    return above;
}

} // namespace gnomon
