#include "glyph_layer.h"

#include <cmath>
#include <numbers>

namespace emca::explorer {

std::vector<Edge> cameraGlyph(const Camera& camera, double imageAspect, float size) {
    const Vec3f d = normalize(camera.direction), up = normalize(camera.up), r = normalize(cross(d, up));
    if (!isFinite(camera.position) || !isFinite(d) || !isFinite(r)) return {};
    std::vector<Edge> edges;
    if (camera.kind == CameraKind::spherical) {
        constexpr int kSteps = 32;
        const Vec3f axes[3][2] = {{r, up}, {up, d}, {d, r}};
        for (const auto& axis : axes)
            for (int i = 0; i < kSteps; ++i) {
                const auto at = [&](int step) {
                    const float a = 2 * std::numbers::pi_v<float> * float(step) / kSteps;
                    return camera.position + (axis[0] * std::cos(a) + axis[1] * std::sin(a)) * (0.4f * size);
                };
                edges.push_back({at(i), at(i + 1)});
            }
        return edges;
    }
    const bool pyramid = camera.kind == CameraKind::perspective;
    const float tangent = pyramid ? std::tan(camera.verticalFieldOfView * std::numbers::pi_v<float> / 360) : 0.4f;
    const float h = size * std::min(tangent, 2.f), w = h * float(imageAspect > 0 ? imageAspect : 1);
    const Vec3f centre = camera.position + d * size;
    const Vec3f corners[4] = {centre - r * w - up * h, centre + r * w - up * h, centre + r * w + up * h, centre - r * w + up * h};
    for (int i = 0; i < 4; ++i) {
        edges.push_back({corners[i], corners[(i + 1) % 4]});
        edges.push_back({pyramid ? camera.position : corners[i] - d * size, corners[i]});
    }
    const Vec3f left = centre + up * (1.15f * h) - r * (0.35f * w), right = centre + up * (1.15f * h) + r * (0.35f * w),
                tip = centre + up * (1.6f * h);
    for (const Edge& e : {Edge{left, right}, Edge{right, tip}, Edge{tip, left}}) edges.push_back(e);
    return edges;
}

GlyphLayer::GlyphLayer(vtkRenderer& strokes) : lines_(strokes) {}

void GlyphLayer::setCamera(const std::optional<Camera>& camera, double imageAspect, float size) {
    camera_ = camera;
    imageAspect_ = imageAspect;
    size_ = std::isfinite(size) && size > 0 ? size : 0.2f;
    rebuild();
}

void GlyphLayer::apply(bool visible, const ThemeColors& colors) {
    visible_ = visible;
    if (color_ == colors.mutedText && halo_ == colors.halo) return;
    color_ = colors.mutedText;   // not one of the colours that mean something
    halo_ = colors.halo;
    rebuild();
}

void GlyphLayer::rebuild() {
    std::vector<Stroke> strokes;
    if (camera_)
        for (const Edge& e : cameraGlyph(*camera_, imageAspect_, size_))
            strokes.push_back({e.from, e.to, 1.6f, StrokeStyle::line, color_});
    lines_.setStrokes(strokes);
    lines_.look().halo = 1;
    lines_.look().haloColor = halo_;
    lines_.look().haloColor.setAlphaF(0.6);
}

void GlyphLayer::prepareFrame(const ViewPose& pose, float pixelScale) {
    lines_.look().pixelScale = pixelScale;
    bool outside = false;
    if (camera_) {
        const Vec3d p{camera_->position.x, camera_->position.y, camera_->position.z};
        outside = length(p - pose.position) > 1.5 * double(size_);
    }
    lines_.setVisible(visible_ && outside);
}

}  // namespace emca::explorer
