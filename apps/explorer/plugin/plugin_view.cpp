#include "plugin/plugin_view.h"

#include <QVBoxLayout>

#include "base/state_overlay.h"
#include "base/theme.h"

namespace emca::explorer {

PluginView::PluginView(Theme& theme, const QString& title, QWidget* parent)
    : QWidget(parent), title_(title), overlay_(new StateOverlay(theme, this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    setMinimumSize(120, 80);
}

void PluginView::setContent(QWidget* content) {
    content_ = content;
    if (!content) return;
    layout()->addWidget(content);
    overlay_->raise();
}

QWidget* PluginView::takeContent() {
    QWidget* content = content_;
    content_.clear();
    if (content) {
        layout()->removeWidget(content);
        content->hide();
    }
    return content;
}

void PluginView::showStopped(const QString& what, std::function<void()> startAgain) {
    overlay_->showError(tr("%1 was stopped: %2").arg(title_, what), tr("Start it again"), std::move(startAgain));
}

}  // namespace emca::explorer
