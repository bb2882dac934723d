#pragma once

#include <vtkNew.h>
#include <vtkOpenGLRenderer.h>

class vtkOpenGLFramebufferObject;

namespace emca::explorer {

/// A renderer that keeps its picture: colour and depth of the last frame are copied back in place of drawing everything
/// again, as long as nobody says that something changed. Surfaces cost most of a frame in software, and a selection
/// changes none of them.
class KeptRenderer : public vtkOpenGLRenderer {
  public:
    static KeptRenderer* New();
    vtkTypeMacro(KeptRenderer, vtkOpenGLRenderer)

    /// The next frame is drawn.
    void forget() { isKept_ = false; }
    /// Frames that were drawn, not copied.
    std::uint64_t drawnFrames() const { return drawnFrames_; }

    void DeviceRender() override;
    void ReleaseGraphicsResources(vtkWindow* window) override;

  protected:
    KeptRenderer();
    ~KeptRenderer() override;

  private:
    bool copy(bool back);
    vtkNew<vtkOpenGLFramebufferObject> kept_;
    int width_ = 0, height_ = 0;
    bool isKept_ = false;
    std::uint64_t drawnFrames_ = 0;
};

}  // namespace emca::explorer
