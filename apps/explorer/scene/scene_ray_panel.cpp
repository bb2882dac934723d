#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "base/qt_compat.h"
#include "scene_panels.h"

namespace emca::explorer {

RayPanel::RayPanel(SceneView& view, Theme&, QWidget* parent) : QWidget(parent), view_(view) {
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setHorizontalSpacing(Spacing::medium);
    grid->setVerticalSpacing(Spacing::tiny);
    const auto add = [&](int row, int column, const QString& text, const QString& name, const QString& tip) {
        auto* box = new QCheckBox(text);
        box->setObjectName(name);
        box->setToolTip(tip);
        grid->addWidget(box, row, column);
        connect(box, &QCheckBox::clicked, this, [this, box] { write(box); });
        return box;
    };
    const auto label = [&](int row, const QString& text) {
        auto* made = new QLabel(text);
        made->setProperty("role", "muted");
        grid->addWidget(made, row, 0);
    };
    label(0, "Current path");
    line_ = add(0, 1, "Line", "pathLine", "Draw the current path, also when others are selected");
    pathNextEvents_ = add(0, 2, "Next event", "pathNextEvents", "Draw the next-event estimation of the current path");
    label(1, "Current vertex");
    incoming_ = add(1, 1, "In", "vertexIncoming", "The ray into the current vertex");
    outgoing_ = add(1, 2, "Out", "vertexOutgoing", "The ray out of the current vertex");
    vertexNextEvents_ = add(2, 1, "Next event", "vertexNextEvents", "Next-event estimation at the current vertex");
    forget_ = new QPushButton("Forget all");
    forget_->setObjectName("forgetRays");
    forget_->setToolTip("All paths and vertices follow the settings above again");
    grid->addWidget(forget_, 2, 2);
    grid->setColumnStretch(2, 1);
    connect(forget_, &QPushButton::clicked, this, [this] { view_.setRaySwitches({}); });
    connect(&view_, &SceneView::optionsChanged, this, &RayPanel::read);
    connect(&view_, &SceneView::selectionShown, this, &RayPanel::read);
    read();
}

void RayPanel::read() {
    reading_ = true;
    const auto path = view_.currentPathRays();
    const auto vertex = view_.currentVertexRays();
    const auto show = [](QCheckBox* box, bool present, bool on) {
        box->setEnabled(present);
        box->setChecked(present && on);
    };
    show(line_, path.has_value(), path && path->line);
    show(pathNextEvents_, path.has_value(), path && path->nextEvents);
    show(incoming_, vertex.has_value(), vertex && vertex->incoming);
    show(outgoing_, vertex.has_value(), vertex && vertex->outgoing);
    show(vertexNextEvents_, vertex.has_value(), vertex && vertex->nextEvents);
    forget_->setEnabled(!view_.raySwitches().empty());
    reading_ = false;
}

void RayPanel::write(QCheckBox* changed) {
    if (reading_) return;
    RaySwitches switches = view_.raySwitches();
    const auto path = view_.currentPathId();
    const auto vertex = view_.currentVertexId();
    if ((changed == line_ || changed == pathNextEvents_) && path) switches.set(*path, {line_->isChecked(), pathNextEvents_->isChecked()});
    else if (vertex) switches.set(*vertex, {incoming_->isChecked(), outgoing_->isChecked(), vertexNextEvents_->isChecked()});
    view_.setRaySwitches(switches);
}

ObjectPanel::ObjectPanel(SceneView& view, Theme& theme, QWidget* parent) : QWidget(parent), view_(view), theme_(theme) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, Spacing::small, 0, 0);
    column->setSpacing(Spacing::small);
    auto* title = new QLabel("Objects of plugins");
    title->setFont(theme_.strongFont());
    column->addWidget(title);
    list_ = new QVBoxLayout;
    list_->setSpacing(Spacing::tiny);
    column->addLayout(list_);
    connect(&view_, &SceneView::optionsChanged, this, &ObjectPanel::read);
    read();
}

void ObjectPanel::read() {
    const auto& entries = view_.objects().entries();
    bool same = entries.size() == boxes_.size();
    for (std::size_t i = 0; same && i < entries.size(); ++i) same = entries[i].id == boxes_[i].first;
    if (!same) {
        for (const auto& [id, box] : boxes_) box->deleteLater();
        boxes_.clear();
        for (const SceneObjects::Entry& entry : entries) {
            auto* box = new QCheckBox;
            box->setObjectName(toQString("object " + entry.id.owner + "/" + entry.id.id));
            list_->addWidget(box);
            connect(box, &QCheckBox::clicked, this, [this, id = entry.id](bool on) { view_.objects().setVisible(id, on); });
            boxes_.emplace_back(entry.id, box);
        }
    }
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const SceneObject& object = *entries[i].object;
        QCheckBox* box = boxes_[i].second;
        box->setText(toQString(object.name));
        box->setToolTip(toQString(object.description.empty() ? "Added by " + entries[i].id.owner : object.description));
        box->setChecked(entries[i].visible);
    }
    setVisible(!entries.empty());
}

}  // namespace emca::explorer
