#include <QButtonGroup>
#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <QVBoxLayout>

#include <algorithm>

#include "base/qt_compat.h"
#include "surface_panel.h"

// The list of SurfacePanel: which layers are collected, and which one is shown.
namespace emca::explorer {
namespace {

enum Column { kName = 0, kShow = 1, kCollect = 2 };

QLabel* muted(const QString& text) {
    auto* label = new QLabel(text);
    label->setProperty("role", "muted");
    return label;
}

}  // namespace

bool SurfacePanel::offers(const std::string& layer) const {
    if (!dataset_.info()) return false;
    return std::ranges::any_of(dataset_.info()->layers, [&](const LayerDescription& l) { return l.name == layer; });
}

std::vector<std::string> SurfacePanel::wantedLayers() const {
    if (!dataset_.info()) return wantsAll_ ? std::vector<std::string>{"all"} : std::vector<std::string>(wanted_.begin(), wanted_.end());
    std::vector<std::string> names;
    for (const LayerDescription& layer : dataset_.info()->layers)
        if (wantsAll_ || wanted_.contains(layer.name)) names.push_back(layer.name);
    return names;
}

void SurfacePanel::setWantedLayers(const std::vector<std::string>& names) {
    wantsAll_ = names == std::vector<std::string>{"all"} && !offers("all");
    wanted_ = wantsAll_ ? std::set<std::string>() : std::set<std::string>(names.begin(), names.end());
    showList();
    emit wantedLayersChanged();
}

void SurfacePanel::setCanRender(bool can) {
    canRender_ = can;
    showWanted();
}

void SurfacePanel::showWanted() {
    const std::size_t count = wantedLayers().size();
    render_->setText(count == 0 ? tr("Render without layers") : count == 1 ? tr("Render with 1 layer") : tr("Render with %1 layers").arg(count));
    render_->setEnabled(canRender_ && count > 0);
}

void SurfacePanel::showList() {
    if (wantsAll_ && dataset_.info()) {   // from here on a person may untick some
        wantsAll_ = false;
        for (const LayerDescription& layer : dataset_.info()->layers) wanted_.insert(layer.name);
    }
    rebuildList();
    const bool offered = dataset_.info() && !dataset_.info()->layers.empty();
    const auto field = dataset_.surface();
    QString hint;
    if (!model_.error().isEmpty()) hint = model_.error();
    else if (model_.isPreparing()) hint = tr("Preparing the surfaces…");
    else if (!dataset_.info()) hint = tr("Connect to a renderer to see which data it can collect on surfaces.");
    else if (!offered && !field)
        hint = tr("This renderer collects no data on surfaces. A renderer offers layers by Renderer::surfaceLayers() and fills them "
                  "in renderImageWithLayers(); docs/recording.md says how.");
    else if (!field) hint = tr("Tick layers and render: they are collected meanwhile.");
    none_->setText(hint);
    none_->setVisible(!hint.isEmpty());
    render_->setVisible(offered);
    showWanted();
    showStyle();
}

void SurfacePanel::rebuildList() {
    // A button of the list may be the one whose click brought this about.
    if (list_) {
        list_->hide();
        list_->deleteLater();
        list_ = nullptr;
    }
    std::vector<LayerDescription> layers;
    if (dataset_.info()) layers = dataset_.info()->layers;
    const auto prepared = model_.surface();
    if (prepared)
        for (const SurfaceLayerData& kept : prepared->field->layers)
            if (!offers(kept.description.name)) layers.push_back(kept.description);
    if (layers.empty()) return;
    list_ = new QWidget;
    auto* grid = new QGridLayout(list_);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setHorizontalSpacing(Spacing::small);
    grid->setVerticalSpacing(2);
    grid->setColumnStretch(kName, 1);
    auto* show = muted(tr("Show"));
    auto* collect = muted(tr("Collect"));
    show->setToolTip(tr("Colour the scene by this layer"));
    collect->setToolTip(tr("Collect it in the next render"));
    grid->addWidget(show, 0, kShow, Qt::AlignHCenter);
    grid->addWidget(collect, 0, kCollect, Qt::AlignHCenter);
    auto* group = new QButtonGroup(list_);
    auto* plain = new QRadioButton;
    plain->setObjectName("show:");
    plain->setChecked(model_.style().layer.empty() || !prepared);
    plain->setToolTip(tr("No layer: the scene in its materials"));
    group->addButton(plain);
    grid->addWidget(new QLabel(tr("None: plain materials")), 1, kName);
    grid->addWidget(plain, 1, kShow, Qt::AlignHCenter);
    connect(plain, &QRadioButton::clicked, this, [this] {
        SurfaceStyle style = model_.style();
        style.layer.clear();
        model_.setStyle(style);
    });
    int row = 2;
    for (const LayerDescription& layer : layers) {
        const bool collected = prepared && prepared->field->find(layer.name);
        addRow(row++, layer, offers(layer.name), collected);
    }
    for (QRadioButton* button : list_->findChildren<QRadioButton*>()) group->addButton(button);
    listPlace_->addWidget(list_);
}

void SurfacePanel::addRow(int row, const LayerDescription& layer, bool offered, bool collected) {
    auto* grid = static_cast<QGridLayout*>(list_->layout());
    const QString name = toQString(layer.name);
    auto* label = new QLabel(name);
    label->setToolTip(toQString(layer.description) + (layer.unit.empty() ? QString() : tr("\nUnit: %1").arg(toQString(layer.unit))));
    if (!collected) label->setProperty("role", "muted");
    auto* show = new QRadioButton;
    show->setObjectName("show:" + name);
    show->setEnabled(collected);
    show->setToolTip(collected ? tr("Colour the scene by this layer") : tr("Not collected yet: tick it and render"));
    show->setChecked(collected && model_.style().layer == layer.name);
    connect(show, &QRadioButton::clicked, this, [this, layer = layer.name] {
        complain({});
        SurfaceStyle style = model_.style();
        style.layer = layer;
        model_.setStyle(style);
    });
    auto* collect = new QCheckBox;
    collect->setObjectName("collect:" + name);
    collect->setEnabled(offered);
    collect->setChecked(offered && wanted_.contains(layer.name));
    collect->setToolTip(tr("Collect it in the next render"));
    connect(collect, &QCheckBox::toggled, this, [this, layer = layer.name](bool on) {
        if (on) wanted_.insert(layer);
        else wanted_.erase(layer);
        showWanted();
        emit wantedLayersChanged();
    });
    grid->addWidget(label, row, kName);
    grid->addWidget(show, row, kShow, Qt::AlignHCenter);
    grid->addWidget(collect, row, kCollect, Qt::AlignHCenter);
}

}  // namespace emca::explorer
