//! Printing a grammar and reading it again gives the same grammar.

use pleach_lsystem::Grammar;
use pleach_lsystem::syntax::{
    BinaryOp, ConstDecl, Context, Dialect, Expr, ExprKind, Function, Item, ModuleName, Name, ParamDecl,
    ParamUnit, Predecessor, Rule, Setting, SettingKey, Shape, Span, Successor, UnaryOp, Values,
};
use proptest::prelude::*;

fn name(text: &str) -> Name {
    Name { text: text.to_owned(), span: Span::default() }
}

fn expr(kind: ExprKind) -> Expr {
    Expr { kind, span: Span::default() }
}

fn identifier() -> impl Strategy<Value = Name> {
    "[a-z][a-z0-9_]{0,3}"
        .prop_filter("keywords", |word| {
            !matches!(word.as_str(), "for" | "in" | "let") && Function::from_name(word).is_none()
        })
        .prop_map(|text| name(&text))
}

fn any_expr() -> impl Strategy<Value = Expr> {
    let number = prop_oneof![(0_u32..100).prop_map(f64::from), 0.0..1e6, Just(1e300), Just(1e-9)];
    let leaf = prop_oneof![
        number.prop_map(|n| expr(ExprKind::Number(n))),
        identifier().prop_map(|n| expr(ExprKind::Name(n.text))),
    ];
    leaf.prop_recursive(4, 24, 3, |inner| {
        let op = prop::sample::select(BinaryOp::ALL.to_vec());
        prop_oneof![
            (op, inner.clone(), inner.clone())
                .prop_map(|(op, a, b)| expr(ExprKind::Binary(op, Box::new([a, b])))),
            (any::<bool>(), inner.clone()).prop_map(|(neg, a)| {
                expr(ExprKind::Unary(if neg { UnaryOp::Neg } else { UnaryOp::Not }, Box::new(a)))
            }),
            [inner.clone(), inner.clone(), inner.clone()]
                .prop_map(|parts| expr(ExprKind::Choose(Box::new(parts)))),
            (identifier(), prop::collection::vec(inner, 0..3))
                .prop_map(|(n, args)| expr(ExprKind::Call(n.text, args))),
        ]
    })
}

/// One-letter symbols, among them those whose runs spell keywords.
fn symbol() -> impl Strategy<Value = Name> {
    prop::sample::select(vec!["F", "A", "f", "o", "r", "l", "e", "t", "+", "-", "!", "/", "|", "Fl"])
        .prop_map(name)
}

fn any_items() -> impl Strategy<Value = Vec<Item>> {
    let module = (symbol(), prop::collection::vec(any_expr(), 0..3))
        .prop_map(|(name, args)| Item::Module { name, args });
    let plain = symbol().prop_map(|name| Item::Module { name, args: Vec::new() });
    let local = (identifier(), any_expr()).prop_map(|(name, value)| Item::Let { name, value });
    let leaf = prop_oneof![4 => plain, 2 => module, 1 => local];
    let item = leaf.prop_recursive(3, 16, 4, |inner| {
        let inside = || prop::collection::vec(inner.clone(), 0..4);
        let values = prop_oneof![
            (any_expr(), any_expr()).prop_map(|(a, b)| Values::Range(a, b)),
            prop::collection::vec(any_expr(), 1..3).prop_map(Values::List),
        ];
        prop_oneof![
            inside().prop_map(Item::Branch),
            inside().prop_map(Item::Polygon),
            (identifier(), values, inside()).prop_map(|(name, values, body)| Item::For {
                name,
                values,
                body
            }),
        ]
    });
    prop::collection::vec(item, 0..6)
}

fn module() -> impl Strategy<Value = Predecessor> {
    (symbol(), prop::collection::vec(identifier(), 0..3))
        .prop_map(|(name, params)| Predecessor { name, params })
}

/// Contexts without signs, which `<`, `>` and `->` would run into.
fn context_module() -> impl Strategy<Value = Predecessor> {
    module().prop_filter("signs", |m| m.name.text.starts_with(|c: char| c.is_ascii_alphabetic()))
}

fn any_rule() -> impl Strategy<Value = Rule> {
    let right = context_module()
        .prop_map(Context::Module)
        .prop_recursive(2, 4, 2, |inner| prop::collection::vec(inner, 1..3).prop_map(Context::Branch));
    let successors = prop_oneof![
        any_items().prop_map(|items| vec![Successor { weight: None, items }]),
        prop::collection::vec((any_expr(), any_items()), 1..3).prop_map(|all| {
            all.into_iter().map(|(weight, items)| Successor { weight: Some(weight), items }).collect()
        }),
    ];
    let contexts = (prop::collection::vec(context_module(), 0..3), prop::collection::vec(right, 0..3));
    (contexts, context_module(), prop::option::of(any_expr()), successors).prop_map(
        |((left, right), pred, condition, successors)| Rule {
            left,
            pred,
            right,
            condition,
            successors,
            span: Span::default(),
        },
    )
}

fn any_param() -> impl Strategy<Value = ParamDecl> {
    let unit = prop::sample::select(ParamUnit::ALL.to_vec());
    (identifier(), -5.0..5.0_f64, any::<bool>(), unit, "[a-z ]{0,9}").prop_map(
        |(name, default, search, unit, doc)| {
            let search = search.then_some((default - 0.5, default + 0.5));
            ParamDecl { name, default, range: (default - 1.0, default + 2.0), search, unit, doc }
        },
    )
}

prop_compose! {
    fn any_grammar()(
        hewitt in any::<bool>(),
        settings in prop::sample::subsequence(SettingKey::ALL.to_vec(), 0..6),
        values in prop::collection::vec(any_expr(), 18),
        params in prop::collection::vec(any_param(), 0..3),
        consts in prop::collection::vec((identifier(), any_expr()), 0..3),
        axiom in any_items(),
        rules in prop::collection::vec(any_rule(), 0..4),
    ) -> Grammar {
        let count = |key: SettingKey| if key.shape() == Shape::Vector { 3 } else { 1 };
        let mut grammar = Grammar {
            dialect: if hewitt { Dialect::Hewitt } else { Dialect::Abop },
            settings: settings
                .into_iter()
                .map(|key| Setting { key, values: values[..count(key)].to_vec(), span: Span::default() })
                .collect(),
            modules: vec![ModuleName { name: name("Fl"), alias: Some(name("F")) }],
            ignore: vec![name("+"), name("Fl")],
            params,
            consts: consts.into_iter().map(|(name, value)| ConstDecl { name, value }).collect(),
            axiom,
            rules: Vec::new(),
        };
        // Neighbours that differ in their weighted successors alone are read as one rule.
        for rule in rules {
            let head = |r: &Rule| (r.head(), r.condition.clone());
            if grammar.rules.last().is_none_or(|last| head(last) != head(&rule)) {
                grammar.rules.push(rule);
            }
        }
        grammar
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn printing_and_reading_is_the_identity(grammar in any_grammar()) {
        let text = grammar.to_string();
        let again = Grammar::parse("again", &text);
        let again = again.map_err(|e| TestCaseError::fail(format!("{e}\nin\n{text}")))?;
        prop_assert_eq!(&again, &grammar, "{}", text);
        prop_assert_eq!(again.to_string(), text);
    }

    #[test]
    fn arbitrary_text_does_no_harm(text in "[ -~\n]{0,200}") {
        let _ = pleach_lsystem::LSystem::read("any", &text);
    }

    #[test]
    fn mutated_grammars_do_no_harm(at in 0_usize..600, with in "[ -~]{0,3}", cut in 0_usize..6) {
        let text = include_str!("../data/mutated.lsys");
        let start = at.min(text.len());
        let end = (start + cut).min(text.len());
        let mutated = format!("{}{with}{}", &text[..start], &text[end..]);
        if let Ok(system) = pleach_lsystem::LSystem::read("mutated", &mutated) {
            let limits = pleach_lsystem::Limits { symbols: 20_000, work: 200_000 };
            let _ = system.derive(&pleach_lsystem::Derivation { limits, ..Default::default() });
            let again = Grammar::parse("again", &system.grammar().to_string());
            prop_assert_eq!(&again.map_err(|e| TestCaseError::fail(e.to_string()))?, system.grammar());
        }
    }
}
