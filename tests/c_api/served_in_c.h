#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "emca/client/connection.h"
#include "emca/emca.h"

namespace emca::test {

/// A renderer of functions behind emca_server_start, and a client.
class ServedInC {
  public:
    explicit ServedInC(const emca_renderer& renderer, const emca_server_options* options = nullptr) {
        emca_error error{};
        EXPECT_EQ(emca_server_start(&renderer, options, &server_, &error), EMCA_OK) << error.message;
    }
    ~ServedInC() {
        client_.reset();
        emca_server_destroy(server_);
    }
    ServedInC(const ServedInC&) = delete;
    ServedInC& operator=(const ServedInC&) = delete;

    emca_server* server() const { return server_; }
    client::Connection& client() {
        if (!client_) {
            auto opened = client::Connection::open({"127.0.0.1", emca_server_port(server_)});
            if (!opened) throw std::runtime_error(opened.error().message);
            client_ = std::move(opened).value();
        }
        return *client_;
    }

  private:
    emca_server* server_ = nullptr;
    std::unique_ptr<client::Connection> client_;
};

}  // namespace emca::test
