#include "stroke_mapper.h"

#include <vtkDataObject.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLHelper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkRenderer.h>
#include <vtkShader.h>
#include <vtkShaderProgram.h>
#include <vtk_glew.h>

#include <string>

namespace emca::explorer {
namespace {

constexpr const char* kVertexShader = R"(//VTK::System::Dec
in vec4 vertexMC;              // x: corner, 0 and 1 at the start, 2 and 3 at the end
in vec3 strokeStart;
in vec3 strokeEnd;
in vec2 strokeShape;           // half width, style
in vec4 strokeColor;
uniform mat4 MCDCMatrix;
uniform mat4 MCVCMatrix;
uniform vec4 strokeViewport;   // x, y, width, height in device pixels
uniform vec2 strokePixels;     // pixel scale, halo
uniform float strokePull;
uniform vec4 strokeClip;
flat out vec4 segment;         // both ends in device pixels
flat out vec4 shape;           // half width in device pixels, style, length, -
flat out vec4 color;
out float viewDepth;

vec2 toPixels(vec4 clip) { return (clip.xy / clip.w * 0.5 + 0.5) * strokeViewport.zw + strokeViewport.xy; }

void main() {
  vec3 start = strokeStart;
  float corner = vertexMC.x;
  vec3 end = strokeEnd;
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  segment = vec4(0.0);
  shape = vec4(0.0);
  color = strokeColor;
  viewDepth = 0.0;
  float ca = dot(strokeClip.xyz, start) + strokeClip.w;
  float cb = dot(strokeClip.xyz, end) + strokeClip.w;
  if (ca < 0.0 && cb < 0.0) return;
  if (ca < 0.0) start = mix(start, end, ca / (ca - cb));
  else if (cb < 0.0) end = mix(end, start, cb / (cb - ca));
  vec4 a = MCDCMatrix * vec4(start, 1.0);
  vec4 b = MCDCMatrix * vec4(end, 1.0);
  // What lies before the near plane is cut off here: it has no place on the screen.
  float da = a.z + a.w;
  float db = b.z + b.w;
  if (da <= 0.0 && db <= 0.0) return;
  if (da < 0.0) { float t = da / (da - db) * 1.0001; a = mix(a, b, t); start = mix(start, end, t); }
  if (db < 0.0) { float t = db / (db - da) * 1.0001; b = mix(b, a, t); end = mix(end, start, t); }
  vec2 pa = toPixels(a);
  vec2 pb = toPixels(b);
  float style = strokeShape.y;
  float halfWidth = strokeShape.x * strokePixels.x;
  vec2 way = pb - pa;
  float len = length(way);
  vec2 u = len > 1e-4 ? way / len : vec2(1.0, 0.0);
  vec2 n = vec2(-u.y, u.x);
  float za = a.z / a.w;
  float zb = b.z / b.w;
  float r = halfWidth + strokePixels.y * strokePixels.x + 1.0;
  float t = corner < 1.5 ? 0.0 : 1.0;
  float side = (corner > 0.5 && corner < 2.5) ? 1.0 : -1.0;
  if (style > 1.5 && style < 2.5) {
    if (len < 5.0 * halfWidth) return;
    vec2 middle = pa + way * 0.56;
    float z = mix(za, zb, 0.56);
    za = z;
    zb = z;
    pa = middle - u * halfWidth;
    pb = middle + u * halfWidth * 1.2;
    start = mix(start, end, 0.56);
    end = start;
  }
  if (style > 3.5) {
    if (len < 1.5 * halfWidth) return;
    pa = pb - u * (2.2 * halfWidth);
    za = zb;
    start = end;
  }
  vec2 pixel = (t < 0.5 ? pa - u * r : pb + u * r) + n * (side * r);
  segment = vec4(pa, pb);
  shape = vec4(halfWidth, style, len, 0.0);
  viewDepth = -(MCVCMatrix * vec4(t < 0.5 ? start : end, 1.0)).z;
  vec2 ndc = (pixel - strokeViewport.xy) / strokeViewport.zw * 2.0 - 1.0;
  // An arrow head lies on its own line: a little nearer to the eye, or they fight.
  float pull = strokePull + ((style > 1.5 && style < 2.5) || style > 3.5 ? 0.003 : 0.0);
  // z/w is linear on the screen, so the quad needs no perspective of its own.
  float z = t < 0.5 ? za : zb;
  gl_Position = vec4(ndc, z - pull * (1.0 - z), 1.0);
}
)";

constexpr const char* kFragmentShader = R"(//VTK::System::Dec
//VTK::Output::Dec
uniform vec2 strokePixels;
uniform float strokeOpacity;
uniform vec4 strokeHalo;       // colour and opacity
uniform vec4 strokeFade;       // colour and strength
uniform vec2 strokeFadeRange;
flat in vec4 segment;
flat in vec4 shape;
flat in vec4 color;
in float viewDepth;

float coverage(float distanceToEdge) { return clamp(0.5 - distanceToEdge, 0.0, 1.0); }

void main() {
  vec2 p = gl_FragCoord.xy;
  vec2 a = segment.xy;
  vec2 way = segment.zw - a;
  float l2 = dot(way, way);
  float along = l2 > 1e-8 ? dot(p - a, way) / l2 : 0.0;
  float edge = distance(p, a + clamp(along, 0.0, 1.0) * way) - shape.x;
  float style = shape.y;
  if ((style > 1.5 && style < 2.5) || style > 3.5) {
    // Triangle: full width at the tail, none at the tip; 0.9 turns the slope into a distance.
    vec2 u = way / sqrt(max(l2, 1e-8));
    float across = abs(dot(p - a, vec2(-u.y, u.x)));
    edge = max(-along * sqrt(l2), (across - shape.x * (1.0 - along)) * 0.9);
  } else if (style > 0.5 && style < 1.5) {
    float period = (6.0 + 2.0 * shape.x) * strokePixels.x + 5.0 * strokePixels.x;
    float s = mod(along * sqrt(l2), period);
    float dash = abs(s - 0.5 * period) - 0.5 * (period - 5.0 * strokePixels.x);
    edge = max(edge, dash);
  }
  float core = coverage(edge) * color.a;
  float halo = coverage(edge - strokePixels.y * strokePixels.x) * strokeHalo.a;
  float fade = strokeFade.a * clamp((viewDepth - strokeFadeRange.x) / (strokeFadeRange.y - strokeFadeRange.x), 0.0, 1.0);
  vec3 ink = mix(color.rgb, strokeFade.rgb, fade);
  float alpha = core + (1.0 - core) * halo;
  if (alpha * strokeOpacity < 0.004) discard;
  vec3 rgb = (ink * core + strokeHalo.rgb * ((1.0 - core) * halo)) / alpha;
  gl_FragData[0] = vec4(rgb, alpha * strokeOpacity);
}
)";

void setColor(vtkShaderProgram& program, const char* name, const QColor& color, float alpha) {
    const float value[4] = {float(color.redF()), float(color.greenF()), float(color.blueF()), alpha};
    program.SetUniform4f(name, value);
}

}  // namespace

vtkStandardNewMacro(StrokeMapper)

StrokeMapper::StrokeMapper() {
    // Both ends of a stroke must go through the matrices as they are.
    SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
    ScalarVisibilityOff();
    MapDataArrayToVertexAttribute("strokeStart", "strokeStart", vtkDataObject::FIELD_ASSOCIATION_POINTS);
    MapDataArrayToVertexAttribute("strokeEnd", "strokeEnd", vtkDataObject::FIELD_ASSOCIATION_POINTS);
    MapDataArrayToVertexAttribute("strokeShape", "strokeShape", vtkDataObject::FIELD_ASSOCIATION_POINTS);
    MapDataArrayToVertexAttribute("strokeColor", "strokeColor", vtkDataObject::FIELD_ASSOCIATION_POINTS);
}

void StrokeMapper::GetShaderTemplate(std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer*, vtkActor*) {
    shaders[vtkShader::Vertex]->SetSource(kVertexShader);
    shaders[vtkShader::Fragment]->SetSource(kFragmentShader);
    shaders[vtkShader::Geometry]->SetSource("");
}

void StrokeMapper::SetMapperShaderParameters(vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor) {
    Superclass::SetMapperShaderParameters(helper, renderer, actor);
    int width = 1, height = 1, x = 0, y = 0;
    renderer->GetTiledSizeAndOrigin(&width, &height, &x, &y);
    const float viewport[4] = {float(x), float(y), float(width), float(height)};
    const float pixels[2] = {look.pixelScale, look.halo};
    const float range[2] = {look.fadeNear, look.fadeFar > look.fadeNear ? look.fadeFar : look.fadeNear + 1};
    vtkShaderProgram& program = *helper.Program;
    program.SetUniform4f("strokeViewport", viewport);
    program.SetUniform2f("strokePixels", pixels);
    program.SetUniformf("strokeOpacity", look.opacity);
    program.SetUniformf("strokePull", look.pull);
    program.SetUniform4f("strokeClip", look.clip);
    setColor(program, "strokeHalo", look.haloColor, look.halo > 0 ? float(look.haloColor.alphaF()) : 0.f);
    setColor(program, "strokeFade", look.fadeColor, look.fade);
    program.SetUniform2f("strokeFadeRange", range);
}

void StrokeMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) {
    auto* window = static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow());
    vtkOpenGLState::ScopedglDepthMask saved(window->GetState());
    window->GetState()->vtkglDepthMask(look.writesDepth ? 1 : 0);
    vtkOpenGLState::ScopedglDepthFunc savedFunction(window->GetState());
    if (look.onTop) window->GetState()->vtkglDepthFunc(GL_ALWAYS);
    Superclass::RenderPieceDraw(renderer, actor);
}

}  // namespace emca::explorer
