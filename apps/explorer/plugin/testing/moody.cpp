// A plugin that does what the environment variable EMCA_TEST_MOOD says, at the moment it says so.
#include <QLabel>
#include <QPushButton>
#include <QThread>
#include <QTimer>
#include <QVBoxLayout>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>

#include "emca/explorer/plugin.h"

namespace {

using namespace emca;
using namespace emca::explorer;

bool mood(const char* wanted) {
    const char* now = std::getenv("EMCA_TEST_MOOD");
    return now && std::strcmp(now, wanted) == 0;
}

void maybe(const char* place) {
    if (mood((std::string("throw in ") + place).c_str())) throw std::runtime_error(std::string("thrown in ") + place);
    if (mood((std::string("throw a number in ") + place).c_str())) throw 7;
    if (mood((std::string("hang in ") + place).c_str())) std::this_thread::sleep_for(std::chrono::hours(1));
    if (mood((std::string("block in ") + place).c_str())) std::this_thread::sleep_for(std::chrono::milliseconds(700));
    if (mood((std::string("crash in ") + place).c_str())) std::abort();
}

[[maybe_unused]] const bool initialised = (maybe("loading"), true);

class MoodyWidget : public QWidget {
  public:
    explicit MoodyWidget(PluginContext& context)
        : context_(context), label_(new QLabel), button_(new QPushButton("press")),
          dataset_(context.onDataset([this](std::uint32_t) {
              maybe("dataset");
              show();
          })),
          selection_(context.onSelection([this](std::uint32_t) {
              maybe("selection");
              show();
          })),
          look_(context.onLook([] { maybe("look"); })), settings_(context.onSettings([this] { label_->setText(context_.setting("word").toString()); })),
          pick_(context.onPick([this](const std::string& id, std::size_t element) {
              maybe("pick");
              label_->setText(QString::fromStdString(id) + QString::number(element));
          })) {
        setObjectName("moody");
        label_->setObjectName("moodyLabel");
        button_->setObjectName("moodyButton");
        auto* layout = new QVBoxLayout(this);
        layout->addWidget(label_);
        layout->addWidget(button_);
        connect(button_, &QPushButton::clicked, this, [this] { press(); });
        auto* timer = new QTimer(this);
        connect(timer, &QTimer::timeout, this, [] { maybe("timer"); });
        timer->start(5);
    }

  protected:
    void paintEvent(QPaintEvent*) override { maybe("paint"); }

  private:
    void show() {
        const auto& paths = context_.dataset().paths();
        label_->setText(QString("%1 paths, %2 selected").arg(paths.pathCount()).arg(context_.selection().state().paths.size()));
    }

    void press() {
        maybe("click");
        if (mood("select")) context_.selectVertex({{Pixel{1, 2}, 2, 0}, 3, Subpath::camera});
        if (mood("say")) context_.say("hello");
        if (mood("set")) context_.setSetting("word", "kept");
        if (mood("object") || mood("bad object")) {
            SceneObject object;
            object.name = mood("object") ? "box" : "";
            object.shape = BoxSet{{ObjectBox::between({0, 0, 0}, {1, 2, 3})}};
            if (const auto set = context_.setObject("bounds", object); !set) label_->setText("refused");
        }
        if (mood("ask"))
            task_ = context_.ask("echo", {std::byte(1), std::byte(2)}, {}, [this](Result<std::vector<std::byte>> reply) {
                label_->setText(reply ? QString("%1 bytes").arg(reply->size()) : QString::fromStdString(reply.error().message));
            });
        if (mood("ask in vain"))
            task_ = context_.ask("slow", {}, {std::chrono::milliseconds(200), {}}, [this](Result<std::vector<std::byte>> reply) {
                label_->setText(reply ? QString("answered") : QString("error %1").arg(int(reply.error().code)));
            });
        if (mood("ask and wait"))
            task_ = context_.ask("slow", {}, {}, [this](Result<std::vector<std::byte>> reply) {
                label_->setText(reply ? QString("answered") : QString::fromStdString(reply.error().message));
            });
        if (mood("ask and throw"))
            task_ = context_.ask("echo", {}, {}, [](Result<std::vector<std::byte>>) { throw std::runtime_error("thrown in answered"); });
        if (mood("work"))
            task_ = context_.run<int>([](const TaskState&) { return 41; }, [this](Result<int> result) { label_->setText(QString::number(*result + 1)); });
        if (mood("work throws"))
            task_ = context_.run<int>([](const TaskState&) -> int { throw std::runtime_error("no luck"); },
                                      [this](Result<int> result) { label_->setText(QString::fromStdString(result.error().message)); });
        if (mood("work that is replaced")) {
            for (int i = 0; i < 2; ++i)
                task_ = context_.run<int>([i](const TaskState&) { return i; },
                                          [this](Result<int> result) { label_->setText(label_->text() + QString(" result %1").arg(*result)); });
        }
        if (mood("endless work"))
            task_ = context_.run<int>([](const TaskState& state) {
                while (!state.cancelled) std::this_thread::sleep_for(std::chrono::milliseconds(1));
                return 0;
            }, [](Result<int>) {});
    }

    PluginContext& context_;
    QLabel* label_;
    QPushButton* button_;
    Task task_;
    Subscription dataset_, selection_, look_, settings_, pick_;
};

QWidget* make(PluginContext& context) {
    maybe("make");
    if (mood("make nothing")) return nullptr;
    return new MoodyWidget(context);
}

}  // namespace

EMCA_EXPLORER_PLUGIN("moody", "Moody", "Does what a test says.", PluginPlace::tools, make)
