#include "kept_renderer.h"

#include <vtkObjectFactory.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtk_glew.h>

namespace emca::explorer {
namespace {

/// Depths are copied between equal formats alone.
struct DepthFormat {
    GLint bits = 0, type = 0, stencilBits = 0;
    friend bool operator==(const DepthFormat&, const DepthFormat&) = default;
};

/// Of the framebuffer that is bound for reading.
DepthFormat readFormat() {
    DepthFormat format;
    const auto ask = [](GLenum attachment, GLenum what, GLint& answer) {
        GLint kind = GL_NONE;
        glGetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, attachment, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &kind);
        if (kind != GL_NONE) glGetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, attachment, what, &answer);
    };
    ask(GL_DEPTH_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE, format.bits);
    ask(GL_DEPTH_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE, format.type);
    ask(GL_STENCIL_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE, format.stencilBits);
    return format;
}

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
        drawn->Bind(GL_READ_FRAMEBUFFER);
        const DepthFormat format = readFormat();
        ready = kept_->PopulateFramebuffer(width_, height_, true, 1, VTK_UNSIGNED_CHAR, true, format.bits, 0, format.stencilBits > 0);
        kept_->Bind(GL_READ_FRAMEBUFFER);
        ready = ready && readFormat() == format;   // else each frame is drawn
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
