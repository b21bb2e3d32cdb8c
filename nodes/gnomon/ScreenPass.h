// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

#include <osg/RenderInfo>
#include <osg/Vec3>
#include <osg/Vec4>

#include <functional>

namespace gnomon {

/// Colour channels.
struct Channels {
    bool red = false;     ///< It is written.
    bool green = false;   ///< The same.
    bool blue = false;    ///< The same.
    bool encoded = false; ///< written as sRGB: what is blended is linear.
};

struct PixelRect;
struct StencilPattern;

/// A step of the compositor within a CleanState: cut to part of the screen, writing nothing but what is asked for.
/// Puts everything back at its end.
class GNOMON_EXPORT ScreenPass {
public:
    /// @param written   asked when colours are written: to these channels only.
    /// @param counters  see counters().
    /// @param pattern   nothing is written but in its pixels.
    ScreenPass(osg::RenderInfo& renderInfo, const PixelRect& pixels, std::function<Channels()> written,
               unsigned counters, const StencilPattern& pattern);
    ~ScreenPass();
    ScreenPass(const ScreenPass&) = delete;
    ScreenPass& operator=(const ScreenPass&) = delete;

    /// Of the draw traversal.
    osg::RenderInfo& renderInfo() const { return _renderInfo; }
    /// What is applied on top of it is to be taken back by osg::State::apply().
    osg::State& state() const { return _state; }

    /// Which fragments a Mark is to draw, and what they hold.
    enum class Want {
        Blocked, ///< where less than half of the light arrives; each sets bit().
        Touched, ///< where not all of it arrives, with the share that does in alpha; each sets bit().
        /// The share that arrives, 0 … 1, in alpha; those of pixels where all of it arrives may be left out. Drawn where no
        /// depth stands.
        Arriving,
        Factor ///< as Touched, with what is left of a pixel's colour: factor() where nothing arrives.
    };
    /// Asks what is drawn next for it. @param bit  of the stencil buffer, zero within the bounds so far.
    void ask(Want want, unsigned bit = 0, float factor = 1.0f);
    /// What was asked for last.
    Want wanted() const { return _wanted; }
    /// The stencil bit that was asked for last; 0 if there is none.
    unsigned bit() const { return _bit; }
    /// Of Want::Factor.
    float factor() const { return _factor; }

    /// Sets these bits to 0 within the bounds.
    void clearStencil(unsigned bits);
    /// Pass where (stencil & test) == (reference & test), then set the bits of `write` to those of `reference`.
    void stencilEqual(unsigned reference, unsigned test, unsigned write);
    /// Pass where any bit of `test` is set.
    void stencilAny(unsigned test);
    /// Pass where any bit of `test` is set, and set `bits` to 0, whatever depth says.
    void takeStencil(unsigned test, unsigned bits);
    /// Stencil bits that nobody else uses, 0 before and after each step: several are the lowest ones, from bit 0 on, so
    /// that they count; one may be any and tells odd from even; 0 if there is none.
    unsigned counters() const { return _counters; }
    /// What is drawn next, closed surfaces, counts in `bits`, one or several as counters() has them, how many of them hold
    /// what stands in the depth buffer, modulo the bits' range (z-fail).
    void countHolding(unsigned bits);
    /// What is drawn next, sides of volumes whose other faces no line of sight meets, counts in `bits` how many of them hold
    /// what stands in the depth buffer, beyond those that hold the eye (z-pass).
    void countEntered(unsigned bits);
    /// What is drawn next takes one from the number in `bits`, if there is any, wherever it is nearer than what stands there.
    void uncount(unsigned bits);
    /// Sets `mark` wherever any of `bits` is set and something stands in the depth buffer; and those to 0.
    void takeCount(unsigned bits, unsigned mark);
    /// True if the pixels beside one may be of another picture: the other eye's.
    bool isInterlaced() const;
    /// Depth becomes the farthest.
    void writeFarDepth();
    /// Colour and alpha become this.
    void writeColor(const osg::Vec4& color);
    /// What is drawn next replaces what stands; ends with endMix().
    void beginReplace();
    /// opacity · color + (1 - opacity) · what stands; alpha stays.
    void blendColor(const osg::Vec3& color, float opacity);
    /// What is drawn next is blended in by its own alpha; that of the frame stays.
    void beginBlend();
    /// What stands is multiplied by the factor; alpha stays.
    void multiplyColor(float factor);
    /// What is drawn next multiplies what stands by the factor, whatever its own colour.
    void beginMultiply(float factor);
    /// What is drawn next and what stands are mixed: (1 - kept) of the one, kept of the other, a channel each. Alpha is
    /// that of what is drawn.
    void beginMix(const osg::Vec3& kept);
    /// Alpha alone becomes that of what is drawn next; ends with endMix().
    void beginAlpha();
    /// Alpha alone becomes the smaller of what stands and that of what is drawn next; ends with endMix().
    void beginLeast();
    /// Colour and alpha become the larger, a channel each, of what stands and what is drawn next; ends with endMix().
    void beginMost();
    /// Ends beginReplace(), beginMix() and the like: no colour is written.
    void endMix();
    /// Alpha alone becomes this, where something stands in the depth buffer: that of the background stays.
    void setAlpha(float value);
    /// Alpha alone becomes factor + (1 - factor) alpha, in the same places.
    void fadeAlpha(float factor);
    /// What is drawn next multiplies alpha by its own, or by what that lacks to 1, and writes nothing else.
    void multiplyAlpha(bool byRest = false);
    /// What stands is multiplied by its alpha, which stays, in the same places.
    void multiplyColorByAlpha();
    /// Passes where what is drawn next compares so with the depth that stands.
    /// @param clamp  what is nearer than the near plane, or beyond the far one, is taken for as far as that; else it is cut off.
    void testDepth(GLenum function, bool clamp = true);

    /// Draws a rectangle over the whole viewport. Depth in normalised device coordinates: z = atCenter + x slopeX + y slopeY.
    void drawQuad(double atCenter = 0.0, double slopeX = 0.0, double slopeY = 0.0);

private:
    void beginMultiplyByColor();
    void count(unsigned bits, bool behind);
    void openChannels(GLboolean alpha) const;
    void openToMultiply();
    void drawColor(const osg::Vec4& color, bool overSurfaces = false);
    void drawAlpha(float alpha);
    void drawOverSurfaces();

    osg::RenderInfo& _renderInfo;
    osg::State& _state;
    const std::function<Channels()> _written;
    const unsigned _counters;
    const StencilPattern& _pattern;
    bool _encodes = false;
    Want _wanted = Want::Blocked;
    unsigned _bit = 0;
    float _factor = 1.0f;
};

} // namespace gnomon
