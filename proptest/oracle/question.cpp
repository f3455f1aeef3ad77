#include "question.hpp"

#include <cstdlib>
#include <fstream>
#include <utility>

namespace halfspace::oracle {

void Inquiry::ask(const Line& question, const std::vector<Answer>& answers) {
  for (const Answer& answer : answers) {
    expected_.push_back({answer.who, questions_.size(), answer.line.text()});
  }
  questions_.push_back(question.text());
  ++asked_;
}

bool Inquiry::settle() {
  const std::vector<std::string> questions = std::move(questions_);
  const std::vector<Expected> expected = std::move(expected_);
  questions_.clear();
  expected_.clear();
  std::string name = "oracle-answers-XXXXXX";
  const int descriptor = mkstemp(name.data());
  if (descriptor < 0) return false;
  // The answers go to a file, so that neither side waits for the other.
  std::FILE* pipe = popen((program_ + " > " + name).c_str(), "w");
  if (pipe == nullptr) return false;
  for (const std::string& question : questions) {
    std::fputs(question.c_str(), pipe);
    std::fputc('\n', pipe);
  }
  if (pclose(pipe) != 0) {
    std::fprintf(stderr, "%s failed\n", program_.c_str());
    good_ = false;
  }
  std::vector<std::string> answers;
  {
    std::ifstream in(name);
    for (std::string line; std::getline(in, line);) answers.push_back(line);
  }
  std::remove(name.c_str());
  if (answers.size() != questions.size()) {
    std::fprintf(stderr, "%zu questions, %zu answers\n", questions.size(),
                 answers.size());
    return good_ = false;
  }
  int told = 0;
  for (const Expected& one : expected) {
    if (answers[one.question] == one.text) continue;
    good_ = false;
    if (++told > 10) break;
    std::fprintf(stderr, "question %s\n  oracle %s\n  %s %s\n",
                 questions[one.question].c_str(), answers[one.question].c_str(),
                 one.who, one.text.c_str());
  }
  return good_;
}

}  // namespace halfspace::oracle
