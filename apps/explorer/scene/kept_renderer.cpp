#include "kept_renderer.h"

#include <vtkObjectFactory.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtk_glew.h>

namespace emca::explorer {
namespace {

constexpr int kDepthBits = 24;   ///< as in VTK's own buffer: depths are copied between equal formats alone

}  // namespace

vtkStandardNewMacro(KeptRenderer)

KeptRenderer::KeptRenderer() = default;
KeptRenderer::~KeptRenderer() = default;

void KeptRenderer::DeviceRender() {
    auto* window = static_cast<vtkOpenGLRenderWindow*>(GetRenderWindow());
    window->MakeCurrent();
    const int* size = window->GetSize();
    if (size[0] != width_ || size[1] != height_) isKept_ = false;
    if (isKept_ && copy(true)) return;
    Superclass::DeviceRender();
    ++drawnFrames_;
    if (size[0] != width_ || size[1] != height_) {
        width_ = size[0];
        height_ = size[1];
        kept_->ReleaseGraphicsResources(window);
    }
    isKept_ = width_ > 0 && height_ > 0 && copy(false);
}

bool KeptRenderer::copy(bool back) {
    auto* window = static_cast<vtkOpenGLRenderWindow*>(GetRenderWindow());
    vtkOpenGLFramebufferObject* drawn = window->GetRenderFramebuffer();
    if (!drawn || drawn->GetMultiSamples() > 0) return false;
    vtkOpenGLState* state = window->GetState();
    state->PushFramebufferBindings();
    kept_->SetContext(window);
    bool ready = kept_->GetFBOIndex() != 0;
    if (!ready) {
        if (back) {
            state->PopFramebufferBindings();
            return false;
        }
        ready = kept_->PopulateFramebuffer(width_, height_, true, 1, VTK_UNSIGNED_CHAR, true, kDepthBits, 0, window->GetStencilCapable() != 0);
    }
    if (ready) {
        vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
        state->vtkglDisable(GL_SCISSOR_TEST);
        (back ? kept_.Get() : drawn)->Bind(GL_READ_FRAMEBUFFER);
        (back ? kept_.Get() : drawn)->ActivateReadBuffer(0);
        (back ? drawn : kept_.Get())->Bind(GL_DRAW_FRAMEBUFFER);
        (back ? drawn : kept_.Get())->ActivateDrawBuffer(0);
        const int extent[4] = {0, width_, 0, height_};
        vtkOpenGLFramebufferObject::Blit(extent, extent, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_NEAREST);
    }
    state->PopFramebufferBindings();
    return ready;
}

void KeptRenderer::ReleaseGraphicsResources(vtkWindow* window) {
    kept_->ReleaseGraphicsResources(window);
    isKept_ = false;
    Superclass::ReleaseGraphicsResources(window);
}

}  // namespace emca::explorer
