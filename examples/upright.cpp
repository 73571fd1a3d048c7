// SPDX-License-Identifier: MIT
// Which way a model is up and what it turns to a viewer, from its shape: upright MODEL
#include <cstdio>
#include <exception>

#include "vantage/io/model.h"
#include "vantage/orientation/orientation.h"

int main(int argc, char** argv) {
  using namespace vantage;
  if (argc != 2) {
    std::fputs("usage: upright MODEL\n", stderr);
    return 2;
  }
  try {
    const Orientation found =
        OrientationEvidence(load_model(argv[1]).mesh).find(OrientationRequest{});
    for (const DirectionChoice* choice : {&found.up, &found.front}) {
      const Vec3& d = choice->direction;
      std::printf("%s is %+.0f %+.0f %+.0f, %.0f %% sure, by the %s\n",
                  choice == &found.up ? "up" : "front", d.x(), d.y(), d.z(),
                  100.0 * choice->confidence, choice->source.c_str());
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "upright: %s\n", error.what());
    return 1;
  }
}
