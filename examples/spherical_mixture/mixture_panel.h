#pragma once

#include <QWidget>
#include <memory>
#include <optional>

#include "emca/explorer/plugin_context.h"
#include "messages.h"
#include "vertex.h"

class QComboBox;
class QLabel;
class QPushButton;
class QSpinBox;
class QTableWidget;
class QToolButton;

namespace mixture {

class LobePicture;

/// The half of the plugin that lives in the explorer: asks for the mixture of the selected vertex and shows its lobes, as a
/// picture, as a table, and as arrows and a body in the 3D view.
class MixturePanel : public QWidget {
    Q_OBJECT
  public:
    explicit MixturePanel(emca::explorer::PluginContext& context);
    const std::optional<Reply>& reply() const { return reply_; }

  public slots:
    void requestFit();

  protected:
    void showEvent(QShowEvent* event) override;

  private:
    void follow();
    void received(emca::Result<std::vector<std::byte>> bytes, const Vertex& vertex);
    void showLobes();
    void showInScene();
    void chooseLobe(std::optional<std::size_t> lobe);

    emca::explorer::PluginContext& context_;
    QPushButton* fit_;
    QToolButton* automatic_;
    QComboBox* source_;
    QSpinBox* components_;
    LobePicture* picture_;
    QLabel* words_;
    QTableWidget* table_;
    std::optional<Vertex> selected_, shown_;
    std::optional<Reply> reply_;
    emca::explorer::Task task_;
    emca::explorer::Subscription onDataset_, onSelection_, onPick_, onLook_;
};

}  // namespace mixture
