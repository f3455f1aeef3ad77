#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <string>

/// Runs the laws with a fixed seed, unless RC_PARAMS names one, and says which.
int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  const char* given = std::getenv("RC_PARAMS");
  std::string params = given == nullptr ? "" : given;
  if (params.find("seed=") == std::string::npos)
    params += std::string(params.empty() ? "" : " ") + "seed=19911983";
  setenv("RC_PARAMS", params.c_str(), 1);
  std::cout << "RC_PARAMS=\"" << params << "\"" << std::endl;
  return RUN_ALL_TESTS();
}
