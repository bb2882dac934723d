#pragma once

#include <QPointer>
#include <QWidget>
#include <functional>

namespace emca::explorer {

class StateOverlay;
class Theme;

/// The place of a plugin in the window: its widget, and the explorer's words in front of it.
class PluginView : public QWidget {
    Q_OBJECT
  public:
    PluginView(Theme& theme, const QString& title, QWidget* parent = nullptr);

    QWidget* content() const { return content_; }
    /// Takes it. Null: nothing but words.
    void setContent(QWidget* content);
    /// Hides the widget and gives it away.
    QWidget* takeContent();
    StateOverlay& overlay() { return *overlay_; }
    void showStopped(const QString& what, std::function<void()> startAgain);
    QSize sizeHint() const override { return {360, 320}; }

  private:
    QString title_;
    QPointer<QWidget> content_;
    StateOverlay* overlay_;
};

}  // namespace emca::explorer
