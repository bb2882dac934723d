#pragma once

#include <QColor>
#include <vtkOpenGLPolyDataMapper.h>

namespace emca::explorer {

/// How a whole layer of strokes is drawn; changing any of it rebuilds no geometry.
struct StrokeLook {
    float opacity = 1;
    float halo = 0;             ///< pixels of outline on each side; 0: none
    QColor haloColor;
    bool writesDepth = false;   ///< true: nearer strokes cut farther ones; false: they add up to a density
    bool onTop = false;         ///< drawn over everything, whatever is nearer
    float fade = 0;             ///< depth cue: how much of the colour is lost at `fadeFar`, in [0, 1]
    float fadeNear = 0, fadeFar = 1;  ///< distances along the view direction
    QColor fadeColor;           ///< what distant strokes turn into
    float pixelScale = 1;       ///< device pixels per pixel of `Stroke::width`
    float clip[4] = {0, 0, 0, 0};  ///< what has dot(clip.xyz, p) + clip.w < 0 is cut away; world space
    float pull = 0;             ///< brings strokes nearer to the eye by this fraction of their distance, off surfaces
};

/// Draws strokes of true width, anti-aliased by their coverage of the pixel.
///
/// OpenGL's own wide lines stay one pixel wide in a core profile, and tubes change their width with distance. So each
/// stroke is a quad that the vertex shader spans around the projected segment; the fragment shader computes the
/// distance to the segment. Nothing is computed on the CPU when the camera moves.
///
/// Input: per stroke four points and two triangles (StrokeLayer makes them). The points' own positions only number the
/// corners, because VTK drops triangles whose points coincide; the arrays strokeStart (3), strokeEnd (3), strokeShape
/// (2: half width, style) and strokeColor (4) hold the rest.
class StrokeMapper : public vtkOpenGLPolyDataMapper {
  public:
    static StrokeMapper* New();
    vtkTypeMacro(StrokeMapper, vtkOpenGLPolyDataMapper)
    StrokeLook look;

    void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override;

  protected:
    StrokeMapper();
    ~StrokeMapper() override = default;
    void GetShaderTemplate(std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
    void SetMapperShaderParameters(vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor) override;
};

}  // namespace emca::explorer
