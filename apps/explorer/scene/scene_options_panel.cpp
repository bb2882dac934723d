#include "scene_options_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QSpinBox>
#include <QVBoxLayout>

#include <cmath>

#include "scene_panels.h"

namespace emca::explorer {

SceneOptionsPanel::SceneOptionsPanel(SceneView& view, Theme& theme, QWidget* parent)
    : QWidget(parent), view_(view), theme_(theme) {
    column_ = new QVBoxLayout(this);
    column_->setContentsMargins(Spacing::medium, Spacing::small, Spacing::medium, Spacing::medium);
    column_->setSpacing(Spacing::small);

    auto* surfaces = section("Surfaces");
    addSlider(surfaces, "Opacity", 0, 1, &SceneOptions::surfaceOpacity, "%", "How much the surfaces hide what is behind them");
    addChoice(surfaces, "Back faces", {"Show", "Fade", "Hide"}, &SceneOptions::backFaces,
              "Surfaces seen from behind, such as the near walls of a room seen from outside");
    addCheck(surfaces, "Colours of the scene", &SceneOptions::ownColors, "Tint the clay by each mesh's diffuse colour");
    addCheck(surfaces, "Creases", &SceneOptions::edges, "Draw creases and borders as thin lines");
    addCheck(surfaces, "Smooth silhouettes", &SceneOptions::smoothEdges, "Anti-alias the borders of surfaces (FXAA)");
    addCheck(surfaces, "Every triangle", &SceneOptions::fullDetail,
             "Of scenes with millions of triangles: draw all of them when nothing moves, even if a frame then takes seconds");
    addCheck(surfaces, "Depth peeling", &SceneOptions::depthPeeling, "Exact order of translucent surfaces; several times as slow in software");

    addClip(section("Clipping plane"));

    auto* paths = section("Paths");
    addChoice(paths, "Show", {"All paths", "Selected paths", "None"}, &SceneOptions::paths,
              "Which recorded paths are drawn; what a filter or the outlier detector finds becomes the selection");
    addSlider(paths, "Line width", 0.5f, 6, &SceneOptions::lineWidth, "px", "Selected paths are 1.75 times as wide");
    addSlider(paths, "Opacity", 0, 1, &SceneOptions::pathOpacity, "%", "Of paths that are not selected");
    addMaximum(paths);
    addCheck(paths, "Arrow heads", &SceneOptions::arrows, "Direction of travel on selected paths");
    addCheck(paths, "Depth numbers", &SceneOptions::depthLabels, "Label the vertices of the current path");
    paths->addRow(new PathColorPanel(view_, theme_));

    auto* rays = section("Rays");
    addChoice(rays, "Next event", {"None", "Current vertex", "Current path", "Selected paths", "All paths"},
              &SceneOptions::nextEvents, "Whose next-event estimation is drawn: blue if visible, red and dashed if occluded");
    addCheck(rays, "Whole current path", &SceneOptions::wholePath, "Otherwise only the rays at the selected vertex");
    addCheck(rays, "Ray into the vertex", &SceneOptions::incoming, "At the selected vertex, without the whole path");
    addCheck(rays, "Ray out of the vertex", &SceneOptions::outgoing, "At the selected vertex, without the whole path");

    rays->addRow(new RayPanel(view_, theme_));

    auto* camera = section("View");
    addCheck(camera, "Orthographic", &SceneOptions::orthographic, "Parallel projection (O)");
    addCheck(camera, "Fly to selection", &SceneOptions::flyToSelection, "Bring a selected path into view");
    addCheck(camera, "Eased moves", &SceneOptions::animate, "Move the camera over a third of a second");
    addCheck(camera, "Camera symbol", &SceneOptions::cameraGlyph, "Draw the renderer's camera");
    addCheck(camera, "Light symbols", &SceneOptions::lightGlyphs, "Arrows where lights shine");
    addCheck(camera, "Axes", &SceneOptions::axes, "Directions of the world's axes, top right");
    addCheck(camera, "Legend", &SceneOptions::legend, "What the colours mean");
    auto* buttons = new QHBoxLayout;
    buttons->setSpacing(Spacing::small);
    for (const auto& [text, tip, slot] : {std::tuple("Reset", "The renderer's camera (Home)", &SceneView::resetCamera),
                                          std::tuple("Focus", "Selection, or the whole scene (F)", &SceneView::focusSelection),
                                          std::tuple("Back", "The view before (Backspace)", &SceneView::back)}) {
        auto* button = new QPushButton(text);
        button->setToolTip(tip);
        connect(button, &QPushButton::clicked, &view_, slot);
        buttons->addWidget(button);
    }
    camera->addRow(buttons);
    section("Picture")->addRow(new PicturePanel(view_, theme_));
    column_->addWidget(new ObjectPanel(view_, theme_));
    column_->addStretch(1);

    const auto read = [this] {
        reading_ = true;
        for (const auto& reader : readers_) reader(view_.options());
        reading_ = false;
    };
    connect(&view_, &SceneView::optionsChanged, this, read);
    read();
}

QFormLayout* SceneOptionsPanel::section(const QString& title) {
    auto* label = new QLabel(title);
    label->setFont(theme_.strongFont());
    if (column_->count() > 0) column_->addSpacing(Spacing::small);
    column_->addWidget(label);
    auto* form = new QFormLayout;
    form->setContentsMargins(0, 0, 0, 0);
    form->setHorizontalSpacing(Spacing::medium);
    form->setVerticalSpacing(Spacing::tiny);
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    column_->addLayout(form);
    return form;
}

void SceneOptionsPanel::change(const std::function<void(SceneOptions&)>& edit) {
    if (reading_) return;
    SceneOptions options = view_.options();
    edit(options);
    view_.setOptions(options);
}

void SceneOptionsPanel::addSlider(QFormLayout* form, const QString& label, float minimum, float maximum,
                                  float SceneOptions::*member, const QString& suffix, const QString& tip) {
    constexpr int kSteps = 100;
    auto* slider = new QSlider(Qt::Horizontal);
    slider->setRange(0, kSteps);
    slider->setToolTip(tip);
    slider->setObjectName(label);
    auto* value = new QLabel;
    value->setFont(theme_.smallNumberFont());
    value->setMinimumWidth(44);
    value->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    auto* row = new QHBoxLayout;
    row->setSpacing(Spacing::small);
    row->addWidget(slider, 1);
    row->addWidget(value);
    form->addRow(label, row);
    connect(slider, &QSlider::valueChanged, this, [=, this](int position) {
        change([&](SceneOptions& o) { o.*member = minimum + (maximum - minimum) * float(position) / kSteps; });
    });
    readers_.push_back([=](const SceneOptions& o) {
        slider->setValue(static_cast<int>(std::lround((o.*member - minimum) / (maximum - minimum) * kSteps)));
        value->setText(suffix == "%" ? QString("%1 %").arg(std::lround(o.*member * 100))
                                     : QString("%1 %2").arg(double(o.*member), 0, 'f', 1).arg(suffix));
    });
}

void SceneOptionsPanel::addCheck(QFormLayout* form, const QString& label, bool SceneOptions::*member, const QString& tip) {
    auto* box = new QCheckBox(label);
    box->setToolTip(tip);
    form->addRow(box);
    connect(box, &QCheckBox::toggled, this, [=, this](bool on) { change([&](SceneOptions& o) { o.*member = on; }); });
    readers_.push_back([=](const SceneOptions& o) { box->setChecked(o.*member); });
}

template <typename Choice>
void SceneOptionsPanel::addChoice(QFormLayout* form, const QString& label, const QStringList& names,
                                  Choice SceneOptions::*member, const QString& tip) {
    auto* combo = new QComboBox;
    combo->addItems(names);
    combo->setToolTip(tip);
    form->addRow(label, combo);
    connect(combo, qOverload<int>(&QComboBox::currentIndexChanged), this, [=, this](int index) {
        change([&](SceneOptions& o) { o.*member = static_cast<Choice>(index); });
    });
    readers_.push_back([=](const SceneOptions& o) { combo->setCurrentIndex(static_cast<int>(o.*member)); });
}

void SceneOptionsPanel::addClip(QFormLayout* form) {
    auto* axis = new QComboBox;
    axis->setObjectName("clipAxis");
    axis->addItems({"Off", "Along x", "Along y", "Along z", "Along the view"});
    axis->setToolTip("Cuts away what lies before a plane: look into closed rooms (X)");
    form->addRow("Cut", axis);
    connect(axis, qOverload<int>(&QComboBox::currentIndexChanged), this, [this](int index) {
        change([&](SceneOptions& o) { o.clip.axis = static_cast<ClipAxis>(index); });
    });
    auto* position = new QSlider(Qt::Horizontal);
    position->setObjectName("clipPosition");
    position->setRange(0, 200);
    position->setToolTip("Where the plane is, from one end of the scene to the other");
    auto* share = new QLabel;
    share->setFont(theme_.smallNumberFont());
    share->setMinimumWidth(44);
    share->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    auto* row = new QHBoxLayout;
    row->setSpacing(Spacing::small);
    row->addWidget(position, 1);
    row->addWidget(share);
    form->addRow("Position", row);
    connect(position, &QSlider::valueChanged, this, [this](int value) { change([&](SceneOptions& o) { o.clip.position = float(value) / 200; }); });
    auto* flip = new QCheckBox("Other side");
    auto* paths = new QCheckBox("Paths as well");
    flip->setObjectName("clipFlip");
    paths->setObjectName("clipPaths");
    flip->setToolTip("Cut away what lies behind the plane");
    paths->setToolTip("Cut paths, too; else they go on through what is cut away");
    auto* switches = new QHBoxLayout;
    switches->setSpacing(Spacing::large);
    switches->addWidget(flip);
    switches->addWidget(paths);
    switches->addStretch(1);
    form->addRow(switches);
    connect(flip, &QCheckBox::toggled, this, [this](bool on) { change([&](SceneOptions& o) { o.clip.flip = on; }); });
    connect(paths, &QCheckBox::toggled, this, [this](bool on) { change([&](SceneOptions& o) { o.clip.paths = on; }); });
    readers_.push_back([=](const SceneOptions& o) {
        axis->setCurrentIndex(static_cast<int>(o.clip.axis));
        position->setValue(static_cast<int>(std::lround(o.clip.position * 200)));
        share->setText(QString("%1 %").arg(double(o.clip.position) * 100, 0, 'f', 0));
        flip->setChecked(o.clip.flip);
        paths->setChecked(o.clip.paths);
        for (QWidget* w : {static_cast<QWidget*>(position), static_cast<QWidget*>(flip), static_cast<QWidget*>(paths)})
            w->setEnabled(o.clip.axis != ClipAxis::none);
    });
}

void SceneOptionsPanel::addMaximum(QFormLayout* form) {
    auto* spin = new QSpinBox;
    spin->setRange(16, 1 << 20);
    spin->setSingleStep(1024);
    spin->setGroupSeparatorShown(true);
    spin->setKeyboardTracking(false);
    spin->setToolTip("More paths than this are thinned out evenly; selected paths are always drawn");
    form->addRow("At most", spin);
    connect(spin, qOverload<int>(&QSpinBox::valueChanged), this, [this](int value) {
        change([&](SceneOptions& o) { o.maximumPaths = static_cast<std::uint32_t>(value); });
    });
    readers_.push_back([=](const SceneOptions& o) { spin->setValue(static_cast<int>(o.maximumPaths)); });
}

}  // namespace emca::explorer
