#pragma once

#include <QWidget>

#include <functional>
#include <vector>

#include "base/theme.h"
#include "scene_view.h"

class QFormLayout;
class QVBoxLayout;

namespace emca::explorer {

/// Everything that can be changed in a SceneView, for a dock (which scrolls it). Shows the view's options whoever changed them.
class SceneOptionsPanel : public QWidget {
    Q_OBJECT
  public:
    SceneOptionsPanel(SceneView& view, Theme& theme, QWidget* parent = nullptr);

  private:
    QFormLayout* section(const QString& title);
    void addSlider(QFormLayout* form, const QString& label, float minimum, float maximum, float SceneOptions::*member,
                   const QString& suffix, const QString& tip);
    void addCheck(QFormLayout* form, const QString& label, bool SceneOptions::*member, const QString& tip);
    template <typename Choice>
    void addChoice(QFormLayout* form, const QString& label, const QStringList& names, Choice SceneOptions::*member,
                   const QString& tip);
    void addMaximum(QFormLayout* form);
    void addClip(QFormLayout* form);
    void change(const std::function<void(SceneOptions&)>& edit);

    SceneView& view_;
    Theme& theme_;
    QVBoxLayout* column_;
    std::vector<std::function<void(const SceneOptions&)>> readers_;   ///< bring one control up to date each
    bool reading_ = false;
};

}  // namespace emca::explorer
