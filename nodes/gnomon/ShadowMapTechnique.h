// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowTechnique.h>

#include <memory>
#include <vector>

namespace gnomon {

class CasterDrawables;
class ShadowMapCache;
struct MapSettings;

/// Casts shadows onto everything visible, by depth maps. Choose it first for general scenes.
///
/// It fits, keeps and biases its maps by itself. Use PlanarShadowNode for flat floors alone, TerrainShadowGeode for
/// buildings on terrain, and TracedShadowTechnique for exact hard edges.
///
///     osg::ref_ptr<gnomon::ShadowMapTechnique> shadow = new gnomon::ShadowMapTechnique;
///     shadow->setSize(2048);
///     group->addChild(shadow);
///
/// Cost
/// - Each frame and light: a copy of the depth buffer and one quad within the shadows' bounds.
/// - When a map changes: one draw of the casters' positions.
/// - Moving casters: a draw of them alone, two copies of the texels they cover, and a second texture of the maps' size.
/// - Each pixel within those bounds: one comparison of 2 × 2 texels; four with BICUBIC, 16 with FINE and SMOOTH edges.
/// - SMOOTH and SOFT edges: another copy and quad, unless a single light blends.
/// - Penumbras: 16 texels and 8 to 32 comparisons more a pixel.
/// - A spot under RELIGHT: another copy and quad over the whole view.
/// Needs
/// - OpenGL 3.0 with GLSL 1.30, and a depth buffer.
/// - One stencil bit a light, and one more where a receiver is named.
/// - SMOOTH and SOFT edges: alpha bits, unless a single light blends.
/// - Penumbras: OpenGL 3.3 or its sampler objects.
/// Limits
/// - An edge is off by a fraction of a texel, see Filter.
/// - An object loses its shadow if it is less than about a texel off the receiver, measured along the light.
/// - A lamp inside a closed box may light single pixels along the box's edges.
/// - A penumbra is that of one straight edge at the blockers' mean distance. Overlapping edges at several distances are
///   only estimated.
/// - Penumbras end at 128 texels, and at the borders of a lamp's six maps.
/// - Blended casters cast as if they were solid.
/// - Drawables that write no depth do not receive. A polygon offset or depth range moves the place that receives.
/// - Multisampled framebuffers are shadowed by pixel, from one sample.
/// - ShadowQuery takes all casters for solid, and ignores spot cones.
/// Threads
/// - Any number of cull and draw threads. Set properties between frames.
/// Source
/// - L. Williams, "Casting Curved Shadows on Curved Surfaces", SIGGRAPH 1978.
/// - W. Reeves, D. Salesin, R. Cook, "Rendering Antialiased Shadows with Depth Maps", SIGGRAPH 1987.
/// - CS-4470, part 2.
///
/// Maps
/// - A map covers only those visible receivers that a caster can shadow, and a sixteenth more on each side.
/// - A map is drawn again if the light or a caster in it changes.
/// - A map is fitted again if the view leaves it or would fill less than half of it.
/// - Casters between a map and the light always count, even outside the map's depth range.
/// - A flat caster, such as a ground, is left out while all visible receivers are on the light's side of it.
/// Texels
/// - A map has only as many texels as the view can show, and never more than setSize().
/// - On the nearest receiver, a texel is at most 1.5 pixels wide, and a third of a pixel for SOFT edges.
/// - A map is drawn again with more texels if it has an eighth too few.
/// Moving casters
/// - Casters are in two layers, static and moving. All start in the static one.
/// - A caster that changes joins the moving layer, at the cost of one full redraw. After that, it is drawn alone.
/// Bias
/// - There is none to set. Both the caster's and the receiver's slope within the compared texels are allowed for, and
///   the rounding of both depths.
/// Spots
/// - A light with a cutoff (osg::Light::setSpotCutoff(), ShadowLight::cutoff) of up to 75 degrees has one map. A wider
///   spot has a lamp's maps.
/// - RELIGHT darkens every pixel outside the cone, exactly. BLEND leaves the cone as OpenGL draws it, by vertex.
/// - OpenGL lights a triangle by its vertices: without a vertex in the cone there is no light, and none is added.
/// - Unlit drawables, such as a sky, darken outside the cone as in any shadow. Name receivers to prevent that.
/// - Without any caster, RELIGHT changes nothing.
/// Alpha tests
/// - A caster with an osg::AlphaFunc casts only its opaque texels: by the 2D texture on unit 0 and its coordinates.
/// - Alpha of vertices and materials counts as 1. If alpha comes from elsewhere, all of the caster casts, and
///   diagnose() says so.
/// - If the map is coarser than the texture, the texture's mipmaps are tested.
///
/// In a file (.osgt, .osgb, .osgx), properties left out have their defaults:
///
///     gnomon::ShadowMapTechnique {
///       UniqueID 2
///       Size 2048
///       Filter BILINEAR
///     }
class GNOMON_EXPORT ShadowMapTechnique : public ShadowTechnique {
public:
    /// How many texels of the map a pixel is compared with. Later filters are more accurate in general, and slower.
    enum Filter : int {
        NEAREST,  ///< One texel: stepped edges.
        BILINEAR, ///< 2 × 2 texels, weighted.
        BICUBIC,  ///< 4 × 4 texels, weighted by cubic B-splines: rounded edges. SMOOTH edges: 4 times 2 × 2 texels,
                  ///< spread over the pixel.
        FINE      ///< SMOOTH edges: 16 times 2 × 2 texels, in maps of twice the resolution, within setSize(). Other
                  ///< edges: as BICUBIC.
    };

    /// How much of a light a pixel at a shadow's edge gets.
    enum Edges : int {
        HARD,   ///< All or nothing: nothing if less than half of the light arrives.
        SMOOTH, ///< The lit share of the pixel: a hard edge without steps. With NEAREST as HARD.
        SOFT    ///< The share of the light that arrives: penumbras. See setSunAngle(), setLampSize() and setRadius().
    };

    /// Debug views, drawn over the finished picture.
    enum View : int {
        NOTHING, ///< No debug view.
        MAP,     ///< Each light's maps in the lower left corner. Near casters are bright, empty texels blue.
        TEXELS,  ///< Width of the first light's texels: blue ¼ pixel, green 1, yellow 3, red 8 or more. A chequerboard
                 ///< shows texels wider than two pixels.
        CASCADES ///< The map of the first light that answers: red (the finest), green, blue, yellow, purple or cyan.
    };

    /// A technique with the default properties.
    ShadowMapTechnique();
    /// Copies the properties.
    ShadowMapTechnique(const ShadowMapTechnique& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    META_Node(gnomon, ShadowMapTechnique)

    /// Most texels on a side of a map, 16 … 16384. Default 1024. Clamped.
    /// A map has fewer if the view cannot show more. Above OpenGL's limit there is no shadow, and diagnose() says so.
    void setSize(int texels);
    /// See setSize().
    int getSize() const { return _size; }

    /// Filter of the comparisons. Default BICUBIC, which also replaces any unknown value.
    void setFilter(Filter filter) { _filter = filter >= NEAREST && filter <= FINE ? filter : BICUBIC; }
    /// See setFilter().
    Filter getFilter() const { return _filter; }

    /// Most cascades (maps) of a sun, 0 … 4. Default 0: as many as keep texels within six pixels. Clamped.
    /// Cascades divide a view that reaches from near to far, such as a street or a landscape. Their depths grow by a
    /// constant ratio. A ratio below two gives fewer cascades. Orthographic views and lamps have one.
    void setCascades(int maps);
    /// See setCascades().
    int getCascades() const { return _cascades; }

    /// Kind of edges. Default HARD, which also replaces any unknown value.
    void setEdges(Edges edges) { _edges = edges == SMOOTH || edges == SOFT ? edges : HARD; }
    /// See setEdges().
    Edges getEdges() const { return _edges; }

    /// SOFT edges: angular diameter of suns, degrees, 0 (a point) … 20. Default 0.533, the sun as seen from the earth.
    /// Clamped. NaN becomes 0.
    void setSunAngle(double degrees);
    /// See setSunAngle().
    double getSunAngle() const { return _sunAngle; }

    /// SOFT edges: diameter of lamps and spots, scene's unit, 0 (a point) … 1e6. Default 0. Clamped. NaN becomes 0.
    void setLampSize(double diameter);
    /// See setLampSize().
    double getLampSize() const { return _lampSize; }

    /// SOFT edges: blur radius, scene's unit, 0 (the filter alone) … 1e6. Default 0. Clamped. NaN becomes 0.
    /// It averages a disc across the light's direction. Every edge then has the same width, for looks.
    void setRadius(double radius);
    /// See setRadius().
    double getRadius() const { return _radius; }

    /// Debug view. Default NOTHING, which also replaces any unknown value.
    /// MAP needs the OpenGL that penumbras need. Pixels without a map stay unchanged. With setProgramUnit() there is no
    /// debug view.
    void setView(View view) { _view = view == MAP || view == TEXELS || view == CASCADES ? view : NOTHING; }
    /// See setView().
    View getView() const { return _view; }

    /// Texture unit, 0 … 31, where the scene's own shader programs find the maps of the first light. Default -1: off.
    /// Other values become -1. With a unit, the technique marks no pixels: only programs with programFunction() show
    /// shadows. Give other drawables a technique of their own.
    void setProgramUnit(int unit) { _programUnit = unit >= 0 && unit < 32 ? unit : -1; }
    /// See setProgramUnit().
    int getProgramUnit() const { return _programUnit; }
    /// GLSL 1.30 source of the lookup function for setProgramUnit(). Add it to a program as another fragment shader.
    /// It returns the share of the light that arrives. Edges follow the filter; there are no penumbras.
    ///
    ///     float gnomon_visibility(vec3 eye); // declare it like this; eye: position in eye coordinates
    std::string programFunction() const;

    /// Number of maps drawn so far, over all lights, views and contexts. It rises only if something changed.
    /// A map counts once a frame if any caster is drawn into it.
    unsigned passes() const;

    /// Updates the maps of one light and makes the jobs that look them up. See ShadowTechnique::prepare().
    std::vector<osg::ref_ptr<MarkJob>> prepare(const ViewFrame& view, const ShadowLight& light,
                                               const FrameCasters& casters) const override;

    /// True: the technique keeps casters by drawable.
    bool takesDrawables() const override { return true; }

    /// Prepares OpenGL objects for more contexts, as osg::Node does.
    void resizeGLObjectBuffers(unsigned maxSize) override;
    /// Releases OpenGL objects, as osg::Node does.
    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~ShadowMapTechnique() override;

private:
    void reportUnknownTests(unsigned frame, const CasterDrawables& pieces) const;
    MapSettings wish() const;

    int _size = 1024;
    Filter _filter = BICUBIC;
    int _cascades = 0;
    Edges _edges = HARD;
    double _sunAngle = 0.533;
    double _lampSize = 0.0, _radius = 0.0;
    View _view = NOTHING;
    int _programUnit = -1;
    std::unique_ptr<ShadowMapCache> _maps;
};

} // namespace gnomon
