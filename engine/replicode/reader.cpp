#include "engine/replicode/reader.h"

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <utility>

#include "engine/base/text.h"
#include "engine/replicode/syntax.h"
#include "engine/replicode/words.h"

namespace aerascope {
namespace {

// The variables of one composite state or model, numbered by first appearance.
class Scope {
 public:
  std::optional<int> Find(const std::string& name) const {
    const auto it = numbers_.find(name);
    return it == numbers_.end() ? std::nullopt : std::optional(it->second);
  }
  int Of(const std::string& name) {
    const auto [it, is_new] = numbers_.try_emplace(name, static_cast<int>(names_.size()));
    if (is_new) names_.push_back(name);
    return it->second;
  }
  int Fresh(std::string name) {
    while (numbers_.contains(name)) name += "_";
    return Of(name);
  }
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::map<std::string, int> numbers_;
  std::vector<std::string> names_;
};

// What a name at top level stands for.
struct Declared {
  enum class Kind { kSymbol, kPayload, kFact, kCompositeState, kModel, kOther };
  Kind kind = Kind::kOther;
  Term term;              // of a symbol or payload
  std::size_t index = 0;  // of a composite state or model
  int line = 0;
};

std::string_view Article(Declared::Kind kind) {
  switch (kind) {
    case Declared::Kind::kSymbol:
      return "a symbol";
    case Declared::Kind::kPayload:
      return "a payload";
    case Declared::Kind::kFact:
      return "a fact";
    case Declared::Kind::kCompositeState:
      return "a composite state";
    case Declared::Kind::kModel:
      return "a model";
    case Declared::Kind::kOther:
      return "something that was passed over";
  }
  return {};
}

bool IsConstantWord(std::string_view word) {
  return std::find(kConstantWords.begin(), kConstantWords.end(), word) != kConstantWords.end();
}

template <std::size_t n>
std::optional<std::string> OperatorOf(
    std::string_view word, const std::array<std::pair<std::string_view, std::string_view>, n>& words) {
  for (const auto& [name, opcode] : words) {
    if (word == name || word == opcode) return std::string(name);
  }
  return std::nullopt;
}

std::string Suggestion(const std::string& word, const std::vector<std::string>& known) {
  const std::string closest = ClosestWord(word, known);
  return closest.empty() ? "" : "; did you mean '" + closest + "'?";
}

class SeedReader {
 public:
  SeedReader(std::string file, const ReplicodeOptions& options) : file_(std::move(file)), options_(options) {
    for (const Term& symbol : options.known_symbols) {
      declared_[symbol.name()] = {Declared::Kind::kSymbol, symbol, 0, 0};
    }
  }

  Result<SeedKnowledge> Read(std::string_view text) {
    SyntaxReader syntax(text, {file_, 1, 1}, {.dump = options_.foreign});
    while (true) {
      Result<std::optional<SyntaxStatement>> statement = syntax.NextStatement();
      if (!statement) return statement.error();
      if (!statement->has_value()) break;
      Status status = ReadStatement(**statement);
      if (status) continue;
      if (!options_.foreign) return status.error();
      seed_.problems.push_back(status.error().message);
      const SyntaxNode& object = (*statement)->object;
      if (!object.label.empty())
        declared_.try_emplace(object.label, Declared{Declared::Kind::kOther, {}, 0, object.line});
    }
    return std::move(seed_);
  }

  Result<Term> ReadPayloadOnly(std::string_view text, const SourceLocation& start) {
    SyntaxReader syntax(text, start);
    Result<SyntaxNode> node = syntax.OnlyExpression();
    if (!node) return node.error();
    return Payload(*node, nullptr);
  }

 private:
  using Kind = SyntaxNode::Kind;

  Error At(const SyntaxNode& node, const std::string& message) const {
    return ErrorAt({file_, node.line, node.column}, message);
  }

  std::vector<std::string> NamesOf(Declared::Kind kind) const {
    std::vector<std::string> names;
    for (const auto& [name, declared] : declared_) {
      if (declared.kind == kind) names.push_back(name);
    }
    return names;
  }

  Error Unknown(const SyntaxNode& node, const Scope* scope) const {
    std::vector<std::string> known = NamesOf(Declared::Kind::kSymbol);
    if (scope) known.insert(known.end(), scope->names().begin(), scope->names().end());
    return At(node, "expected a declared name, found '" + node.text + "', which is not declared above" +
                        Suggestion(node.text, known));
  }

  // ------------------------------------------------------------------------------------------------ fields
  // of groups

  // The first fields of a group, one for each name; `::` stands for all that are left. At most `tail` more
  // may follow: numbers, wildcards or truth values without a meaning here.
  Result<std::vector<const SyntaxNode*>> Fields(const SyntaxNode& group,
                                                std::initializer_list<std::string_view> names,
                                                std::size_t tail) const {
    std::vector<const SyntaxNode*> fields;
    for (const std::string_view name : names) {
      if (!fields.empty() && fields.back()->kind == Kind::kRest) {
        fields.push_back(fields.back());
        continue;
      }
      if (fields.size() >= group.items.size()) {
        return At(group, "expected the " + std::string(name) + " in (" + Printable(group.text) +
                             " ...), found only " + std::to_string(group.items.size()) +
                             (group.items.size() == 1 ? " field" : " fields"));
      }
      fields.push_back(&group.items[fields.size()]);
      if (!fields.back()->label.empty()) {
        return At(*fields.back(), "expected the " + std::string(name) + " without a label, found '" +
                                      Printable(fields.back()->label) + ":'");
      }
    }
    for (std::size_t i = fields.size(); i < group.items.size(); ++i) {
      const SyntaxNode& item = group.items[i];
      const bool meaningless = item.kind == Kind::kNumber || item.kind == Kind::kWildcard ||
                               item.kind == Kind::kRest ||
                               (item.kind == Kind::kName && (item.text == "true" || item.text == "false"));
      if (i >= names.size() + tail || !meaningless) {
        return At(item, "expected the end of (" + Printable(group.text) + " ...), found " + Described(item));
      }
    }
    return fields;
  }

  Result<const SyntaxNode*> ListField(const SyntaxNode& group, std::size_t i, std::string_view what) const {
    if (i >= group.items.size()) {
      return At(group, "expected the list of " + std::string(what) + " in (" + group.text +
                           " ...), found only " + std::to_string(group.items.size()) +
                           (group.items.size() == 1 ? " field" : " fields"));
    }
    const SyntaxNode& item = group.items[i];
    if (item.kind != Kind::kList || !item.label.empty()) {
      return At(item, "expected the list of " + std::string(what) + ", found " + Described(item));
    }
    return &item;
  }

  // ----------------------------------------------------------------------------------------------------------
  // values

  // A null scope reads values without variables and wildcards.
  Result<Term> Value(const SyntaxNode& node, Scope* scope) {
    switch (node.kind) {
      case Kind::kName:
        return Named(node, scope);
      case Kind::kNumber:
        return Term::Number(node.number);
      case Kind::kInstant:
        return Term::Instant(TimeOf(node.us));
      case Kind::kDuration:
        return Term::Span({node.us});
      case Kind::kString:
        return Term::String(node.text);
      case Kind::kVariable:
        if (!scope)
          return At(node, "expected a value, found the variable '" + node.text + ":', which has none here");
        return Term::Variable(scope->Of(node.text));
      case Kind::kWildcard:
      case Kind::kRest:
        if (!scope) return At(node, "expected a value, found the wildcard " + Described(node));
        return Term::Wildcard();
      case Kind::kList:
        return ListValue(node, scope);
      case Kind::kGroup:
        return StructValue(node, scope);
    }
    return At(node, "expected a value");
  }

  Result<Term> Named(const SyntaxNode& node, const Scope* scope) {
    if (node.text == "nil") return Term::Nil();
    if (node.text == "true" || node.text == "false") return Term::Bool(node.text == "true");
    if (node.text == "forever" || node.text == "GIGASEC" || node.text == "MAX_TIME")
      return Term::Instant(kForever);
    if (node.text == "sampling_period") return Term::Span(options_.sampling_period);
    if (scope) {
      if (const auto variable = scope->Find(node.text)) return Term::Variable(*variable);
    }
    const auto it = declared_.find(node.text);
    if (it == declared_.end()) return Unknown(node, scope);
    if (it->second.kind != Declared::Kind::kSymbol) {
      return At(node, "expected an entity or ontology symbol, found '" + node.text + "', which is " +
                          std::string(Article(it->second.kind)));
    }
    return it->second.term;
  }

  Result<Term> ListValue(const SyntaxNode& node, Scope* scope) {
    std::vector<Term> items;
    for (const SyntaxNode& item : node.items) {
      if (item.kind == Kind::kRest)
        return At(item, "expected the elements of the list one by one, found '::'");
      if (!item.label.empty())
        return At(item, "expected a value without a label, found '" + item.label + ":'");
      Result<Term> value = Value(item, scope);
      if (!value) return value;
      items.push_back(std::move(*value));
    }
    return Term::Set(std::move(items));
  }

  Result<Term> StructValue(const SyntaxNode& node, Scope* scope) {
    std::vector<std::string> known;
    for (const auto& [head, size] : kValueStructs) {
      known.emplace_back(head);
      if (node.text != head) continue;
      if (node.items.size() != size) {
        return At(node, "expected " + std::to_string(size) + " fields in (" + node.text + " ...), found " +
                            std::to_string(node.items.size()));
      }
      std::vector<Term> items;
      for (const SyntaxNode& item : node.items) {
        if (!item.label.empty())
          return At(item, "expected a value without a label, found '" + item.label + ":'");
        Result<Term> value = head == "ti" ? Instant(item, scope) : Value(item, scope);
        if (!value) return value;
        items.push_back(std::move(*value));
      }
      return Term::Struct(node.text, std::move(items));
    }
    return At(node, "expected a value, found (" + Printable(node.text) + " ...); structured values are " +
                        Join(known, ", ") + Suggestion(node.text, known));
  }

  static Time TimeOf(std::int64_t us) { return us == kGigaSecondUs ? kForever : Time{us}; }

  Result<Term> Instant(const SyntaxNode& node, Scope* scope) {
    if (node.kind == Kind::kDuration) return Term::Instant({node.us});
    Result<Term> value = Value(node, scope);
    if (!value) return value;
    if (value->is(TermKind::kTime) || value->is(TermKind::kVariable) || value->is(TermKind::kWildcard))
      return value;
    return At(node, "expected a time such as 0s:100ms:0us, found " + Described(node));
  }

  // --------------------------------------------------------------------------------------------------------
  // payloads

  Result<Term> Payload(const SyntaxNode& node, Scope* scope) {
    if (node.kind == Kind::kName) {
      const auto it = declared_.find(node.text);
      if (it == declared_.end()) return Unknown(node, nullptr);
      const bool entity = it->second.kind == Declared::Kind::kSymbol && it->second.term.is(TermKind::kEntity);
      if (it->second.kind == Declared::Kind::kPayload || entity) return it->second.term;
      return At(node, "expected something that can be a fact, found '" + node.text + "', which is " +
                          std::string(Article(it->second.kind)));
    }
    if (node.kind == Kind::kGroup) {
      if (node.text == "mk.val") return ValuePayload(node, scope);
      if (node.text == "cmd") return CommandPayload(node, scope);
      if (node.text == "icst") return IcstPayload(node, scope);
      if (node.text == "imdl") return ImdlPayload(node, scope);
      return At(node, "expected (mk.val ...), (cmd ...), (icst ...) or (imdl ...), found (" +
                          Printable(node.text) + " ...)" +
                          Suggestion(node.text, {"mk.val", "cmd", "icst", "imdl"}));
    }
    return At(node, "expected something that can be a fact, such as (mk.val ...), found " + Described(node));
  }

  Result<Term> ValuePayload(const SyntaxNode& node, Scope* scope) {
    const auto fields = Fields(node, {"object", "attribute", "value"}, 1);
    if (!fields) return fields.error();
    const Result<Term> object = Value(*(*fields)[0], scope);
    if (!object) return object;
    if (!object->is(TermKind::kEntity) && !object->is(TermKind::kVariable) &&
        !object->is(TermKind::kWildcard)) {
      return At(*(*fields)[0], "expected an entity as the object, found " + Described(*(*fields)[0]));
    }
    const Result<Term> attribute = Value(*(*fields)[1], scope);
    if (!attribute) return attribute;
    if (!attribute->is(TermKind::kOntology) && !attribute->is(TermKind::kVariable) &&
        !attribute->is(TermKind::kWildcard)) {
      return At(*(*fields)[1],
                "expected an ontology symbol as the attribute, found " + Described(*(*fields)[1]));
    }
    Result<Term> value = Value(*(*fields)[2], scope);
    if (!value) return value;
    return MakeValue(*object, *attribute, std::move(*value));
  }

  Result<Term> CommandPayload(const SyntaxNode& node, Scope* scope) {
    const auto fields = Fields(node, {"name of the command", "list of arguments"}, 1);
    if (!fields) return fields.error();
    const SyntaxNode& name = *(*fields)[0];
    if (options_.foreign && name.kind == Kind::kName && !declared_.contains(name.text)) {
      DeclareSymbol(Term::Ontology(name.text), name.line);
    }
    const Result<Term> function = Value(name, scope);
    if (!function) return function;
    if (!function->is(TermKind::kOntology)) {
      return At(name, "expected an ontology symbol as the name of the command, found " + Described(name));
    }
    if ((*fields)[1]->kind != Kind::kList) {
      return At(*(*fields)[1],
                "expected the list of arguments of the command, found " + Described(*(*fields)[1]));
    }
    Result<Term> arguments = ListValue(*(*fields)[1], scope);
    if (!arguments) return arguments;
    return Term::Struct("cmd", {*function, std::move(*arguments)});
  }

  // The composite state or model named by the first field of an icst or imdl.
  Result<std::size_t> Reference(const SyntaxNode& node, Declared::Kind kind) const {
    const auto it = declared_.find(node.text);
    if (node.kind == Kind::kName && it != declared_.end() && it->second.kind == kind) return it->second.index;
    return At(node, "expected the label of " + std::string(Article(kind)) + " declared above, found " +
                        Described(node) +
                        (node.kind == Kind::kName ? Suggestion(node.text, NamesOf(kind)) : ""));
  }

  Result<std::vector<Term>> Arguments(const SyntaxNode& list, std::string_view what, Scope* scope) {
    if (list.kind != Kind::kList)
      return At(list, "expected the list of " + std::string(what) + ", found " + Described(list));
    const Result<Term> values = ListValue(list, scope);
    if (!values) return values.error();
    return std::vector<Term>(values->items().begin(), values->items().end());
  }

  Error WrongCount(const SyntaxNode& list, const std::string& label, std::string_view what,
                   std::size_t expected, std::size_t found, const std::string& names) const {
    return At(list, "expected " + std::to_string(expected) + " " + std::string(what) +
                        (expected == 1 ? "" : "s") + " for " + label +
                        (names.empty() ? "" : " (" + names + ")") + ", found " + std::to_string(found));
  }

  static std::string NamesText(const std::vector<int>& variables, const std::vector<std::string>& names) {
    std::vector<std::string> parts;
    for (const int v : variables) parts.push_back(names[static_cast<std::size_t>(v)]);
    return Join(parts, " ");
  }

  Result<Term> IcstPayload(const SyntaxNode& node, Scope* scope) {
    const auto fields =
        Fields(node, {"composite state", "list of template arguments", "list of arguments"}, 2);
    if (!fields) return fields.error();
    const Result<std::size_t> index = Reference(*(*fields)[0], Declared::Kind::kCompositeState);
    if (!index) return index.error();
    const SeedCompositeState& state = seed_.composite_states[*index];
    Result<std::vector<Term>> arguments = Arguments(*(*fields)[1], "template arguments", scope);
    if (!arguments) return arguments.error();
    Result<std::vector<Term>> rest = Arguments(*(*fields)[2], "arguments", scope);
    if (!rest) return rest.error();
    // A composite state's template variables come first in its numbering, so both lists make one.
    arguments->insert(arguments->end(), rest->begin(), rest->end());
    const std::vector<int> expected = ArgumentVariables(state.state);
    if (arguments->size() != expected.size()) {
      return WrongCount(*(*fields)[2], state.label, "argument", expected.size(), arguments->size(),
                        NamesText(expected, state.state.variable_names));
    }
    return MakeIcst(state.state.id, {}, *arguments);
  }

  Result<Term> ImdlPayload(const SyntaxNode& node, Scope* scope) {
    const auto fields = Fields(node, {"model", "list of template arguments", "list of exposed arguments"}, 2);
    if (!fields) return fields.error();
    const Result<std::size_t> index = Reference(*(*fields)[0], Declared::Kind::kModel);
    if (!index) return index.error();
    const SeedModel& model = seed_.models[*index];
    Result<std::vector<Term>> template_arguments = Arguments(*(*fields)[1], "template arguments", scope);
    if (!template_arguments) return template_arguments.error();
    if (template_arguments->size() != model.model.template_arguments.size()) {
      return WrongCount(*(*fields)[1], model.label, "template argument",
                        model.model.template_arguments.size(), template_arguments->size(), "");
    }
    Result<std::vector<Term>> exposed = Arguments(*(*fields)[2], "exposed arguments", scope);
    if (!exposed) return exposed.error();
    const std::vector<int> expected = ExposedVariables(model.model);
    if (exposed->size() != expected.size()) {
      return WrongCount(*(*fields)[2], model.label, "exposed argument", expected.size(), exposed->size(),
                        NamesText(expected, model.model.variable_names));
    }
    return MakeImdl(model.model.id, *template_arguments, *exposed);
  }

  // ------------------------------------------------------------------------------------------------
  // patterns, guards

  Result<FactPattern> Pattern(const SyntaxNode& node, Scope* scope) {
    if (!node.IsGroup("fact") && !node.IsGroup("|fact")) {
      return At(node, "expected (fact ...) or (|fact ...), found " + Described(node));
    }
    if (!node.label.empty())
      return At(node, "expected a condition without a label, found '" + node.label + ":'");
    const auto fields = Fields(node, {"payload", "start", "end"}, 2);
    if (!fields) return fields.error();
    FactPattern pattern;
    pattern.positive = node.text == "fact";
    Result<Term> payload = Payload(*(*fields)[0], scope);
    if (!payload) return payload.error();
    Result<Term> after = Instant(*(*fields)[1], scope);
    if (!after) return after.error();
    Result<Term> before = Instant(*(*fields)[2], scope);
    if (!before) return before.error();
    pattern.payload = std::move(*payload);
    pattern.after = std::move(*after);
    pattern.before = std::move(*before);
    return pattern;
  }

  Result<Term> Expression(const SyntaxNode& node, Scope* scope) {
    if (node.kind != Kind::kGroup) return Value(node, scope);
    const auto op = OperatorOf(node.text, kArithmeticWords);
    if (!op) {
      const Result<Term> value = StructValue(node, scope);
      if (value || node.text == "vec2" || node.text == "vec3" || node.text == "ti") return value;
      return At(node, "expected +, -, *, / or a value, found (" + Printable(node.text) + " ...)");
    }
    return Operation(node, *op, scope);
  }

  Result<Term> Operation(const SyntaxNode& node, const std::string& op, Scope* scope) {
    if (node.items.size() != 2) {
      return At(node, "expected two operands of " + op + ", found " + std::to_string(node.items.size()));
    }
    std::vector<Term> operands;
    for (const SyntaxNode& item : node.items) {
      if (!item.label.empty())
        return At(item, "expected an operand without a label, found '" + item.label + ":'");
      Result<Term> operand = Expression(item, scope);
      if (!operand) return operand;
      operands.push_back(std::move(*operand));
    }
    return Term::Struct(op, std::move(operands));
  }

  Result<std::vector<Guard>> Guards(const SyntaxNode& group, std::size_t i, std::string_view what,
                                    Scope* scope) {
    std::vector<Guard> guards;
    if (i >= group.items.size()) return guards;
    const Result<const SyntaxNode*> list = ListField(group, i, what);
    if (!list) return list.error();
    for (const SyntaxNode& item : (*list)->items) {
      const auto test = item.kind == Kind::kGroup ? OperatorOf(item.text, kTestWords) : std::nullopt;
      if (item.label.empty() == !test) {
        return At(item, "expected an assignment such as P1:(+ P0 D) or a test such as (<> P1 P0), found " +
                            (item.label.empty() ? "" : "'" + item.label + ":' before ") + Described(item));
      }
      Result<Term> expression = test ? Operation(item, *test, scope) : Expression(item, scope);
      if (!expression) return expression.error();
      std::optional<int> target;
      if (!test) target = scope->Of(item.label);
      guards.push_back({target, std::move(*expression)});
    }
    return guards;
  }

  // ------------------------------------------------------------------------------------------------------
  // statements

  Status ReadStatement(const SyntaxStatement& statement) {
    const SyntaxNode& object = statement.object;
    if (statement.directive) {
      if (!options_.foreign) {
        return At(object, "expected !def, the only directive read here, found '" + object.text + "'" +
                              Suggestion(object.text, {"!def"}));
      }
      ++seed_.passed_over[object.text];
      return Ok();
    }
    if (!object.label.empty()) {
      const auto it = declared_.find(object.label);
      if (it != declared_.end() && !(options_.foreign && it->second.line == 0)) {
        return At(object, "expected a new label, found '" + object.label + "', which is declared already" +
                              (it->second.line > 0 ? " in line " + std::to_string(it->second.line) : ""));
      }
      if (IsConstantWord(object.label)) {
        return At(object, "expected a label, found '" + object.label + "', which is a word of the language");
      }
    }
    if (object.text == "ent" || object.text == "ont") return ReadSymbol(object);
    if (object.text == "fact" || object.text == "|fact") return ReadFact(object);
    if (object.text == "cst") return ReadCompositeState(object);
    if (object.text == "mdl") return ReadModel(object, statement.views);
    if (object.text == "mk.val" || object.text == "cmd" || object.text == "icst" || object.text == "imdl") {
      return ReadNamedPayload(object);
    }
    if (options_.foreign) {
      ++seed_.passed_over[object.text];
      Declare(object, Declared::Kind::kOther, {}, 0);
      return Ok();
    }
    const std::vector<std::string> known{"ent", "ont", "fact", "|fact", "mk.val", "cst", "mdl"};
    return At(object, "expected one of " + Join(known, ", ") + ", found (" + Printable(object.text) +
                          " ...); programs, commands and drives belong into the scenario file" +
                          Suggestion(object.text, known));
  }

  void Declare(const SyntaxNode& object, Declared::Kind kind, Term term, std::size_t index) {
    if (!object.label.empty()) declared_[object.label] = {kind, std::move(term), index, object.line};
  }

  void DeclareSymbol(const Term& symbol, int line) {
    seed_.symbols.push_back(symbol);
    declared_[symbol.name()] = {Declared::Kind::kSymbol, symbol, 0, line};
  }

  Status ReadSymbol(const SyntaxNode& object) {
    if (object.label.empty()) {
      return At(object, "expected a label in front, such as h:(" + object.text + " 1), found none");
    }
    const auto fields = Fields(object, {}, 1);
    if (!fields) return fields.error();
    DeclareSymbol(object.text == "ent" ? Term::Entity(object.label) : Term::Ontology(object.label),
                  object.line);
    return Ok();
  }

  // OpenAERA's dumps have facts about instances whose arguments are not all bound.
  Scope* OpenScope(Scope* scope) const { return options_.foreign ? scope : nullptr; }

  Status ReadNamedPayload(const SyntaxNode& object) {
    if (object.label.empty()) {
      return At(object, "expected a label in front of (" + object.text + " ...), or a (fact ...) around it");
    }
    Scope open;
    Result<Term> payload = Payload(object, OpenScope(&open));
    if (!payload) return payload.error();
    Declare(object, Declared::Kind::kPayload, std::move(*payload), 0);
    return Ok();
  }

  Status ReadFact(const SyntaxNode& object) {
    if (options_.foreign && !object.items.empty() && PassedOver(object.items[0])) {
      ++seed_.passed_over[object.text + " about what was passed over"];
      Declare(object, Declared::Kind::kOther, {}, 0);
      return Ok();
    }
    const auto fields = Fields(object, {"payload", "start", "end"}, 2);
    if (!fields) return fields.error();
    SeedFact read{object.label, {}};
    Scope open;
    Result<Term> payload = Payload(*(*fields)[0], OpenScope(&open));
    if (!payload) return payload.error();
    const Result<Term> after = Instant(*(*fields)[1], nullptr);
    if (!after) return after.error();
    const Result<Term> before = Instant(*(*fields)[2], nullptr);
    if (!before) return before.error();
    read.fact.positive = object.text == "fact";
    read.fact.payload = std::move(*payload);
    read.fact.interval = {after->time(), before->time()};
    if (read.fact.interval.before < read.fact.interval.after) {
      return At(*(*fields)[2], "expected an end after the start " + ToText(after->time()) + ", found " +
                                   ToText(before->time()));
    }
    if (object.items.size() > 3 && object.items[3].kind == Kind::kNumber) {
      read.fact.confidence = object.items[3].number;
      if (read.fact.confidence < 0 || read.fact.confidence > 1) {
        return At(object.items[3],
                  "expected a confidence from 0 to 1, found " + FormatNumber(read.fact.confidence));
      }
    }
    Declare(object, Declared::Kind::kFact, {}, 0);
    seed_.facts.push_back(std::move(read));
    return Ok();
  }

  // In OpenAERA's texts: a goal, a prediction, or a label of something passed over.
  bool PassedOver(const SyntaxNode& payload) const {
    if (payload.kind == Kind::kGroup) {
      return payload.text != "mk.val" && payload.text != "cmd" && payload.text != "icst" &&
             payload.text != "imdl";
    }
    const auto it = declared_.find(payload.text);
    return payload.kind == Kind::kName && it != declared_.end() && it->second.kind == Declared::Kind::kOther;
  }

  std::int64_t NextNumber() const {
    return static_cast<std::int64_t>(seed_.composite_states.size() + seed_.models.size()) + 1;
  }

  Result<std::vector<Term>> TemplateArguments(const SyntaxNode& object, Scope* scope) {
    const Result<const SyntaxNode*> list = ListField(object, 0, "template arguments");
    if (!list) return list.error();
    std::vector<Term> arguments;
    for (const SyntaxNode& item : (*list)->items) {
      Result<Term> argument = Value(item, scope);
      if (!argument) return argument.error();
      // Mostly a variable or (ti T0: T1:); a value that is always the same, such as [], stands there as it
      // is.
      if (argument->is(TermKind::kWildcard) || !item.label.empty()) {
        return At(item, "expected a variable, (ti T0: T1:) or another value as a template argument, found " +
                            Described(item));
      }
      arguments.push_back(std::move(*argument));
    }
    return arguments;
  }

  Status ReadCompositeState(const SyntaxNode& object) {
    if (object.label.empty()) return At(object, "expected a label in front of (cst ...), found none");
    Scope scope;
    SeedCompositeState read{object.label, {}};
    CompositeState& state = read.state;
    const auto template_arguments = TemplateArguments(object, &scope);  // numbers its variables first
    if (!template_arguments) return template_arguments.error();
    const Result<const SyntaxNode*> components = ListField(object, 1, "conditions");
    if (!components) return components.error();
    if ((*components)->items.empty() || (*components)->items.size() > kMaxComponents) {
      return At(**components, "expected 1 to " + std::to_string(kMaxComponents) +
                                  " conditions in a composite state, found " +
                                  std::to_string((*components)->items.size()));
    }
    for (const SyntaxNode& item : (*components)->items) {
      Result<FactPattern> component = Component(item, state, &scope);
      if (!component) return component.error();
      state.components.push_back(std::move(*component));
    }
    Result<std::vector<Guard>> forward = Guards(object, 2, "forward guards", &scope);
    if (!forward) return forward.error();
    const Result<std::vector<Guard>> backward = Guards(object, 3, "backward guards", &scope);
    if (!backward) return backward.error();
    if (!backward->empty() && *backward != *forward) {
      return At(object.items[3],
                "expected the backward guards of a composite state to be empty or equal to the forward ones");
    }
    if (Status status = ReadTail(object, 4, 1); !status) return status;
    state.guards = std::move(*forward);
    state.variable_names = scope.names();
    state.id = {NextNumber()};
    Declare(object, Declared::Kind::kCompositeState, {}, seed_.composite_states.size());
    seed_.composite_states.push_back(std::move(read));
    return Ok();
  }

  // The next condition of `state`. Wildcards in its interval become the variables of the first condition, or,
  // in the first one, new variables.
  Result<FactPattern> Component(const SyntaxNode& item, const CompositeState& state, Scope* scope) {
    Result<FactPattern> component = Pattern(item, scope);
    if (!component) return component;
    if (!IsValue(component->payload) && !IsIcst(component->payload)) {
      return At(item, "expected (mk.val ...) or (icst ...) as a condition of a composite state, found " +
                          Described(item.items[0]));
    }
    const bool first = state.components.empty();
    if (component->after.is(TermKind::kWildcard)) {
      component->after = first ? Term::Variable(scope->Fresh("T0")) : state.components[0].after;
    }
    if (component->before.is(TermKind::kWildcard)) {
      component->before = first ? Term::Variable(scope->Fresh("T1")) : state.components[0].before;
    }
    if (first) {
      if (component->after.is(TermKind::kVariable) && component->before.is(TermKind::kVariable))
        return component;
      return At(item, "expected variables as the interval of a condition of a composite state");
    }
    if (component->after == state.components[0].after && component->before == state.components[0].before)
      return component;
    return At(item, "expected the interval of the first condition (" +
                        ToText(state.components[0].after, scope->names()) + ": " +
                        ToText(state.components[0].before, scope->names()) +
                        ":), which all conditions of a composite state share");
  }

  // Output groups and then at most `numbers` numbers.
  Status ReadTail(const SyntaxNode& object, std::size_t i, std::size_t numbers) const {
    if (i < object.items.size()) {
      if (const auto groups = ListField(object, i, "output groups"); !groups) return groups.error();
    }
    for (std::size_t k = i + 1; k < object.items.size(); ++k) {
      if (object.items[k].kind != Kind::kNumber || k > i + numbers) {
        return At(object.items[k],
                  "expected the end of (" + object.text + " ...), found " + Described(object.items[k]));
      }
    }
    return Ok();
  }

  // Phased out is a model whose activation in the primary group is 0: a view [sync time salience resilience
  // primary origin 0] (semantics 1.4, 3.5). All else that views say is read over.
  static bool IsPhasedOut(const SyntaxNode& views) {
    return std::any_of(views.items.begin(), views.items.end(), [](const SyntaxNode& view) {
      return view.kind == Kind::kList && view.items.size() == 7 && view.items[4].kind == Kind::kName &&
             view.items[4].text == kPrimaryGroup && view.items[6].kind == Kind::kNumber &&
             view.items[6].number == 0;
    });
  }

  Status ReadModel(const SyntaxNode& object, const SyntaxNode& views) {
    if (object.label.empty()) return At(object, "expected a label in front of (mdl ...), found none");
    Scope scope;
    SeedModel read{object.label, {}, {}, false};
    Model& model = read.model;
    Result<std::vector<Term>> template_arguments = TemplateArguments(object, &scope);
    if (!template_arguments) return template_arguments.error();
    model.template_arguments = std::move(*template_arguments);
    const Result<const SyntaxNode*> sides = ListField(object, 1, "left and right side");
    if (!sides) return sides.error();
    if ((*sides)->items.size() != 2) {
      return At(**sides, "expected two facts, the left and the right side of the model, found " +
                             std::to_string((*sides)->items.size()));
    }
    Result<FactPattern> lhs = Pattern((*sides)->items[0], &scope);
    if (!lhs) return lhs.error();
    Result<FactPattern> rhs = Pattern((*sides)->items[1], &scope);
    if (!rhs) return rhs.error();
    if (!lhs->payload.is(TermKind::kStruct)) {
      return At((*sides)->items[0],
                "expected (mk.val ...), (cmd ...), (icst ...) or (imdl ...) on the left side of a model");
    }
    if (IsCommand(rhs->payload)) {
      return At((*sides)->items[1], "expected no command on the right side of a model; commands are causes");
    }
    model.lhs = std::move(*lhs);
    model.rhs = std::move(*rhs);
    Result<std::vector<Guard>> forward = Guards(object, 2, "forward guards", &scope);
    if (!forward) return forward.error();
    Result<std::vector<Guard>> backward = Guards(object, 3, "backward guards", &scope);
    if (!backward) return backward.error();
    model.forward = std::move(*forward);
    model.backward = std::move(*backward);
    if (Status status = ReadTail(object, 4, 5); !status) return status;
    if (Status status = ReadEvidence(object, &read); !status) return status;
    if (IsPhasedOut(views)) read.state = ModelState::kPhasedOut;
    model.variable_names = scope.names();
    model.id = {NextNumber()};
    Declare(object, Declared::Kind::kModel, {}, seed_.models.size());
    seed_.models.push_back(std::move(read));
    return Ok();
  }

  // Strength, count and success rate, after the output groups.
  Status ReadEvidence(const SyntaxNode& object, SeedModel* model) const {
    const auto number = [&](std::size_t i) { return object.items[i].number; };
    if (object.items.size() > 5) {
      if (number(5) != 0 && number(5) != 1) {
        return At(object.items[5],
                  "expected 0 or 1 as the strength of a model, found " + FormatNumber(number(5)));
      }
      model->strong = number(5) == 1;
    }
    double rate = 1;
    if (object.items.size() > 6) {
      if (number(6) < 1 || number(6) > 1e9) {
        return At(object.items[6],
                  "expected a count of tries from 1 to 1e9, found " + FormatNumber(number(6)));
      }
      model->evidence.total = number(6);
    }
    if (object.items.size() > 7) {
      rate = number(7);
      if (rate < 0 || rate > 1) {
        return At(object.items[7], "expected a success rate from 0 to 1, found " + FormatNumber(rate));
      }
    }
    model->evidence = EvidenceOf(rate, model->evidence.total);
    return Ok();
  }

  std::string file_;
  ReplicodeOptions options_;
  SeedKnowledge seed_;
  std::map<std::string, Declared> declared_;
};

}  // namespace

Result<SeedKnowledge> ReadReplicode(std::string_view text, const std::string& file,
                                    const ReplicodeOptions& options) {
  return SeedReader(file, options).Read(text);
}

Result<Term> ReadPayload(std::string_view text, const SourceLocation& start,
                         const ReplicodeOptions& options) {
  return SeedReader(start.file, options).ReadPayloadOnly(text, start);
}

}  // namespace aerascope
