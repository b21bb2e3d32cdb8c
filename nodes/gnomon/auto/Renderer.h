// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/choice/CandidateChoice.h>
#include <gnomon/compositor/ShadowJob.h>

#include <atomic>

namespace gnomon {

/// Who draws, as far as that is known.
enum class Renderer { Unknown, Processor, Graphics };

/// The renderer that is current, by its name.
Renderer currentRenderer();

/// The same, once a view has drawn.
struct RendererFact : public DrawWatch {
    std::atomic<Renderer> value{Renderer::Unknown};

    void begin(osg::RenderInfo&) override;

protected:
    ~RendererFact() override = default;
};

/// What work costs there. Where nobody knows, a graphics processor draws.
inline const RendererRates& ratesOf(Renderer renderer) {
    return renderer == Renderer::Processor ? llvmpipeRates : graphicsRates;
}

} // namespace gnomon
