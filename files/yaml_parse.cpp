#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <sstream>

#include "files/yaml_tree.hpp"

namespace shakebed::files {

namespace {

using Kind = YamlNode::Kind;

std::string place(const YamlSource& source, const YAML::Mark& mark) {
  if (!source.origin.empty()) return source.origin;
  if (mark.is_null()) return source.name;
  // yaml-cpp counts lines and columns from 0.
  return source.name + ":" + std::to_string(mark.line + 1) + ":" + std::to_string(mark.column + 1);
}

/// Builds a YamlTree from the parser's events. yaml-cpp's own tree would have lost duplicate keys
/// and the difference between 10 and "10".
class Builder final : public YAML::EventHandler {
 public:
  Builder(const YamlSource& source, std::vector<Fault>& faults)
      : source_(source), faults_(faults) {}

  std::shared_ptr<const YamlTree> root() const { return root_; }

  int documents() const { return documents_; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ == 2)
      report(mark,
             "expected nothing more here: a stray character, or a second document in the file");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    refuse_anchor(mark, anchor);
    auto node = made(Kind::null, mark);
    // The parser has read on to the next token: the key is the better place for a missing value.
    if (!open_.empty() && open_.back().has_key) node->where = open_.back().key_where;
    add(mark, std::move(node));
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
    report(mark, "aliases (*name) are not supported; write the value out");
    add(mark, made(Kind::null, mark));
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    auto node = made(Kind::scalar, mark);
    node->text = value;
    node->plain = tag == "?";
    add(mark, std::move(node));
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    start(Kind::sequence, mark, tag, anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    start(Kind::map, mark, tag, anchor);
  }
  void OnSequenceEnd() override { finish(); }
  void OnMapEnd() override { finish(); }

 private:
  struct Open {
    std::shared_ptr<YamlTree> node;
    YAML::Mark mark;
    bool has_key = false;
    std::string key;
    std::string key_where;
  };

  void report(const YAML::Mark& mark, const std::string& what) {
    faults_.push_back({place(source_, mark), what});
  }
  void refuse_anchor(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) report(mark, "anchors (&name) are not supported");
  }
  void refuse_tag(const YAML::Mark& mark, const std::string& tag) {
    if (!tag.empty() && tag != "?" && tag != "!") {
      report(mark, "tags (`" + tag + "`) are not supported; write the plain value");
    }
  }

  std::shared_ptr<YamlTree> made(Kind kind, const YAML::Mark& mark) const {
    auto node = std::make_shared<YamlTree>();
    node->kind = kind;
    node->where = place(source_, mark);
    if (open_.empty()) {
      node->path = source_.root_path;
    } else if (const Open& parent = open_.back(); parent.node->kind == Kind::sequence) {
      node->path = parent.node->path + "[" + std::to_string(parent.node->elements.size()) + "]";
    } else {
      node->path = child_path(parent.node->path, parent.key);
    }
    return node;
  }

  void start(Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    open_.push_back({made(kind, mark), mark, false, {}, {}});
  }

  void finish() {
    auto closed = std::move(open_.back());
    open_.pop_back();
    add(closed.mark, std::move(closed.node));
  }

  void add(const YAML::Mark& mark, std::shared_ptr<YamlTree> node) {
    if (open_.empty()) {
      if (!root_) root_ = std::move(node);
      return;
    }
    Open& parent = open_.back();
    if (parent.node->kind == Kind::sequence) {
      parent.node->elements.push_back(std::move(node));
    } else if (!parent.has_key) {
      take_key(parent, mark, *node);
    } else {
      parent.has_key = false;
      add_entry(parent, std::move(node));
    }
  }

  void take_key(Open& parent, const YAML::Mark& mark, const YamlTree& node) {
    if (node.kind != Kind::scalar) report(mark, "a key must be a word");
    parent.has_key = true;
    parent.key = node.text;
    parent.key_where = place(source_, mark);
  }

  void add_entry(Open& parent, std::shared_ptr<YamlTree> node) {
    if (parent.key == "<<") {
      faults_.push_back(
          {parent.key_where, "merge keys (<<) are not supported; write the keys out"});
    } else if (const auto* first = parent.node->find(parent.key)) {
      faults_.push_back({parent.key_where, "key `" + parent.key + "` was already given at " +
                                               first->where + "; keep one of the two"});
    } else {
      parent.node->entries.push_back({parent.key, parent.key_where, std::move(node)});
    }
  }

  const YamlSource& source_;
  std::vector<Fault>& faults_;
  std::vector<Open> open_;
  std::shared_ptr<const YamlTree> root_;
  int documents_ = 0;
};

}  // namespace

std::shared_ptr<const YamlTree> parse_yaml(std::string_view text, const YamlSource& source,
                                           std::vector<Fault>& faults) {
  Builder builder(source, faults);
  try {
    std::istringstream stream{std::string(text)};
    YAML::Parser parser(stream);
    // A stray comma makes yaml-cpp hand out empty documents without end.
    while (builder.documents() < 2 && parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    throw bad_input(place(source, error.mark), "is not valid YAML: " + error.msg);
  } catch (const std::exception& error) {
    // yaml-cpp lets standard exceptions escape on some malformed escapes and directives.
    throw bad_input(source.origin.empty() ? source.name : source.origin,
                    std::string("is not valid YAML: ") + error.what());
  }
  if (builder.root()) return builder.root();
  auto empty = std::make_shared<YamlTree>();
  empty->where = source.origin.empty() ? source.name + ":1:1" : source.origin;
  empty->path = source.root_path;
  return empty;
}

}  // namespace shakebed::files
