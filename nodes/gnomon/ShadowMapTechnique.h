// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowTechnique.h>

#include <memory>
#include <vector>

namespace gnomon {

class LightMaps;
struct MapWish;

/// Shadow on everything that is seen, by depth maps: the casters drawn once as each light sees them, and what is seen
/// compared with that.
///
///     osg::ref_ptr<gnomon::ShadowMapTechnique> shadow = new gnomon::ShadowMapTechnique;
///     shadow->setSize(2048);
///     group->addChild(shadow);
///
/// Maps    A map covers what of the seen receivers the casters can darken, and no more: the smallest rectangle about it, and
///         a sixteenth more on each side so that it holds for a while. It is drawn again only when the light has changed or a
///         caster in it, or when what is seen is no longer in it or would fill less than half of it. Casters between it and the
///         light count wherever they are. What is flat along an axis of the group, as grounds are, is left out while all that
///         is seen is on the light's side of it: it darkens nothing.
/// Texels  as many as the view can show, and no more than setSize() allows: 1.5 pixels are as wide as the widest, on what of
///         the seen receivers is nearest, or, for soft edges, a third of one. A map is drawn again with more when they are an
///         eighth too few, and with fewer when half of them would do and it is to be drawn anyway.
/// Moving  Casters are in two layers. What has changed since it was first met, as by a transform above it, is in the one that
///         moves: it alone is extracted and drawn when it changes again, in those maps that it is or was in, over what stands
///         still, which stays in the map. What stood still and begins to move, or goes, costs one drawing of all.
/// Bias    none to set. Both the surface in the map and the one that is seen allow for their own slope within the texels
///         that are compared, and for the rounding of depth, here and in the frame. Thin things lose their shadow where
///         they are less than about a texel off the surface, measured along the light.
/// Spots   a lamp with a cutoff (osg::Light::setSpotCutoff(), ShadowLight::cutoff) has one map, about its cone, up
///         to a cutoff of 75 degrees, wider ones have those of a lamp; and nothing without casters. RELIGHT
///         takes its light from all that is outside the cone, to the pixel, where OpenGL alone decides a vertex; BLEND
///         leaves that as OpenGL has drawn it, which is without the light as far as vertices tell. Where no vertex is
///         in the cone OpenGL gives no light, and none is added. What is unlit, as a sky, is darkened outside the cone as in
///         any shadow: name receivers where there is such a thing.
/// Alpha   of casters with an alpha test (osg::AlphaFunc) casts what that leaves of them, by the alpha of the 2D texture on
///         unit 0 at coordinates given a vertex; where alpha comes from elsewhere, all of them casts, and diagnose() says
///         so.
/// Edges   hard: what gets less than half of the light, by the filter, gets none. Smooth: the same edge, a pixel wide.
///         Soft, see setEdges(): as much as the filter says, or, of a light that is seen under an angle, as much as comes
///         past what stands before it: its penumbra, where that is wider than two texels.
///
/// Cost    while nothing changes, a copy of the depth buffer and one quad over what the shadows' bounds cover; a draw of
///         all casters' positions when a map is made. Where casters move, those alone and two copies of what of the map they
///         cover, and a second texture of the maps' size. A spot that relights takes another copy and quad, of all that is
///         seen.
///         Of a pixel 1, 1 or 4 comparisons of 2 × 2 texels, by the filter; smooth and soft edges take another copy and
///         quad unless a single light blends, and in penumbras 16 texels and 8 to 32 comparisons more.
/// Needs   OpenGL 3.0 with GLSL 1.30 and a depth buffer; 1 stencil bit a light, 1 more where a receiver is named. Smooth
///         and soft edges: alpha bits, but for a single light that blends; penumbras: OpenGL 3.3 or its sampler objects.
/// Limits  A shadow's edge is off by a fraction of a texel, see setFilter(); through the edges of a closed box with a lamp in
///         it single pixels may be lit. A penumbra is that of one straight edge as far
///         away as what blocks the light there is on average: where several edges at several distances overlap it is a
///         guess; it is cut at 128 texels, and at the sides of a lamp's six maps. Of alpha tests, alpha of vertices and
///         materials counts as 1, and where the map is coarser than the texture its mipmaps are what is tested; what is
///         blended casts as if it were solid. A ShadowQuery takes all casters for solid and knows no cones. What writes no
///         depth does not receive; what is drawn with a polygon offset or a depth range of its own receives as if it stood
///         where its depth says. Multisampled framebuffers are decided a pixel, by one of its samples.
/// Threads any number of cull and draw threads; set properties between frames.
/// Source: L. Williams, "Casting Curved Shadows on Curved Surfaces", SIGGRAPH 1978; CS-4470, part 2; W. Reeves, D. Salesin
///         and R. Cook, "Rendering Antialiased Shadows with Depth Maps", SIGGRAPH 1987.
///
/// In a file (.osgt, .osgb, .osgx), where what is left out has its default:
///
///     gnomon::ShadowMapTechnique {
///       UniqueID 2
///       Size 2048
///       Filter BILINEAR
///     }
class GNOMON_EXPORT ShadowMapTechnique : public ShadowTechnique {
public:
    /// How a pixel is compared with the map. How far the middle of an edge is off, 95 % of it, is of random edges.
    enum Filter : int {
        NEAREST,  ///< with one texel: steps, 0.51 texel off.
        BILINEAR, ///< with 2 × 2, weighted: 0.41 texel off.
        BICUBIC, ///< with 4 × 4, weighted by cubic B-splines: rounded, 0.35 texel off; smooth edges: with 4 times 2 × 2,
                 ///< spread over the pixel.
        FINE ///< smooth edges: with 16 times 2 × 2, of maps with twice as many texels a pixel, as far as setSize() lets
             ///< them be had; others as BICUBIC.
    };

    enum Edges : int {
        HARD,   ///< a pixel has all of a light or none of it.
        SMOOTH, ///< where an edge passes through it, it has what of the light is on its lit side; with NEAREST as HARD.
        SOFT    ///< it has the share that arrives.
    };

    /// What is drawn over the finished picture, to see how maps lie.
    enum View : int {
        NOTHING, ///< which is the default.
        MAP,     ///< each light's maps in the lower left corner, near things bright; blue where nothing stands.
        TEXELS, ///< how wide a texel of the first light is: blue a quarter of a pixel, green one, yellow three, red eight or
                ///< more; a chequerboard of texels that are wider than two.
        CASCADES ///< which map of the first light answers: red, green, blue, yellow, purple, cyan; the finest is red.
    };

    ShadowMapTechnique();
    ShadowMapTechnique(const ShadowMapTechnique& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    META_Node(gnomon, ShadowMapTechnique)

    /// Texels on a side of each map, at most, 16 … 16384; default 1024. Clamped; beyond what OpenGL has there is no shadow,
    /// and diagnose() says so. Fewer are used where the view can show no more, see Texels.
    void setSize(int texels);
    int getSize() const { return _size; }

    /// Default BICUBIC, which any value that is none of them stands for too.
    void setFilter(Filter filter) { _filter = filter >= NEAREST && filter <= FINE ? filter : BICUBIC; }
    Filter getFilter() const { return _filter; }

    /// Maps of a sun, 0 … 4: that many at most; default 0, as many as keep their texels to six pixels, which keeps 95 %
    /// of the edges to within about a pixel. Clamped. What is seen is divided by its distance along the line of sight, so
    /// that each part is as many times as far at its end as at its beginning, and each part has a map of its own: for
    /// views that reach from near to far, a street or a landscape. Fewer are made where a part's end would be less than
    /// twice as far as its beginning; one for orthographic views and for lamps.
    void setCascades(int maps);
    int getCascades() const { return _cascades; }

    /// Default HARD, which any value that is none of them stands for too. What follows counts where edges are soft.
    void setEdges(Edges edges) { _edges = edges == SMOOTH || edges == SOFT ? edges : HARD; }
    Edges getEdges() const { return _edges; }

    /// Angle under which suns are seen, degrees, 0 … 20; default 0.533, the sun's own from the earth; 0 is a point, whose edges
    /// are as wide as the filter. Clamped; what is not a number is 0.
    void setSunAngle(double degrees);
    double getSunAngle() const { return _sunAngle; }

    /// Diameter of lamps and spots, scene's unit, 0 … 1e6; default 0, a point. Clamped; what is not a number is 0.
    void setLampSize(double diameter);
    double getLampSize() const { return _lampSize; }

    /// Radius of the disc, across the light's way, that is averaged about every place, scene's unit, 0 … 1e6: edges as wide
    /// as that wherever they fall, for looks; default 0, the filter alone. Clamped; what is not a number is 0.
    void setRadius(double radius);
    double getRadius() const { return _radius; }

    /// Default NOTHING, which any value that is none of them stands for too. MAP needs what penumbras need. What no map
    /// answers for is left as it is; with a program unit nothing is drawn.
    void setView(View view) { _view = view == MAP || view == TEXELS || view == CASCADES ? view : NOTHING; }
    View getView() const { return _view; }

    /// Texture unit, 0 … 31, at which the programs of all that this view draws find the maps of the group's first light, for
    /// shading of their own; default -1: no program does, and shadows are marked as ever. With a unit nothing is marked.
    /// Values that are none of them are -1. What is drawn by OpenGL's fixed functions is drawn as if there were no shadow; give
    /// such things a technique of their own.
    void setProgramUnit(int unit) { _programUnit = unit >= 0 && unit < 32 ? unit : -1; }
    int getProgramUnit() const { return _programUnit; }
    /// The function for such programs, GLSL 1.30, to be added to them as a fragment shader of its own, which compares as the
    /// filter says; edges are as soft as that, penumbras it does not know.
    ///
    ///     float gnomon_visibility(vec3 eye); // declare it; eye: in eye coordinates
    std::string programFunction() const;

    /// Maps drawn so far, over all lights, views and contexts: rises only where something changed. A map counts once in a
    /// frame in which anything is drawn into it, all casters or those that move; not, if all that moves is beside it.
    unsigned passes() const;

    std::vector<osg::ref_ptr<MarkJob>> prepare(const ViewFrame& view, const ShadowLight& light,
                                               const GroupCasters& casters) const override;

    bool takesPieces() const override { return true; }

    void resizeGLObjectBuffers(unsigned maxSize) override;
    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~ShadowMapTechnique() override;

private:
    void reportUnknownTests(unsigned frame, const CasterPieces& pieces) const;
    MapWish wish() const;

    int _size = 1024;
    Filter _filter = BICUBIC;
    int _cascades = 0;
    Edges _edges = HARD;
    double _sunAngle = 0.533;
    double _lampSize = 0.0, _radius = 0.0;
    View _view = NOTHING;
    int _programUnit = -1;
    std::unique_ptr<LightMaps> _maps;
};

} // namespace gnomon
