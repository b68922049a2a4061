// The backend that the program of tests was started with; see main.cpp.
#pragma once

#include <string>
#include <vector>

namespace plumb::ogre::tests {

const std::string& tested_backend();

/// The others that are built and held to every check.
std::vector<std::string> other_backends();

}  // namespace plumb::ogre::tests
