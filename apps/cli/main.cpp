#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "command.h"

int main(int argc, char** argv) {
    try {
        return emca::cli::run(std::vector<std::string>(argv + 1, argv + argc));
    } catch (const std::exception& e) {
        std::fprintf(stderr, "error: emca gave up: %s. This is a fault of ours; please report it.\n", e.what());
        return emca::cli::Exit::server;
    }
}
