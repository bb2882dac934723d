#pragma once

#include <QStringList>
#include <QWidget>

#include <vector>

#include "base/theme.h"
#include "scene_view.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;
class QVBoxLayout;

namespace emca::explorer {

// Parts of the options of the 3D view that are more than a switch each.

/// By what paths are coloured: quantity, map, range.
class PathColorPanel : public QWidget {
    Q_OBJECT
  public:
    PathColorPanel(SceneView& view, Theme& theme, QWidget* parent = nullptr);

  private:
    void fill();
    void read();
    void change(const PathColorStyle& style);
    void quantityEntered();
    void rangeTyped();

    SceneView& view_;
    Theme& theme_;
    QStringList names_;
    QComboBox *quantity_, *map_;
    QLineEdit *minimum_, *maximum_;
    QCheckBox* log_;
    QPushButton* automatic_;
    QLabel* complaint_;
    std::vector<QWidget*> rows_;
    bool reading_ = false;
};

/// What is drawn of the current path and at the current vertex, whatever is drawn of others.
class RayPanel : public QWidget {
    Q_OBJECT
  public:
    RayPanel(SceneView& view, Theme& theme, QWidget* parent = nullptr);

  private:
    void read();
    void write(QCheckBox* changed);

    SceneView& view_;
    QCheckBox *line_, *pathNextEvents_, *incoming_, *outgoing_, *vertexNextEvents_;
    QPushButton* forget_;
    bool reading_ = false;
};

/// A switch for each object that plugins add; hidden without any.
class ObjectPanel : public QWidget {
    Q_OBJECT
  public:
    ObjectPanel(SceneView& view, Theme& theme, QWidget* parent = nullptr);

  private:
    void read();

    SceneView& view_;
    Theme& theme_;
    QVBoxLayout* list_;
    std::vector<std::pair<ObjectId, QCheckBox*>> boxes_;
};

/// Saves the view as a picture of a size that one chooses.
class PicturePanel : public QWidget {
    Q_OBJECT
  public:
    PicturePanel(SceneView& view, Theme& theme, QWidget* parent = nullptr);
    /// Asks for a file beside the window, which goes on meanwhile, and writes it.
    void ask();

  private:
    void save(const QString& file);

    SceneView& view_;
    Theme& theme_;
    QSpinBox *width_, *height_;
    QLabel* answer_;
    QString last_ = "scene.png";
};

}  // namespace emca::explorer
