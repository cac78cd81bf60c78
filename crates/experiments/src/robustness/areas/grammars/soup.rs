//! Random texts: any bytes, and words of the language in any order.

use pleach_fit::Stream;

/// Longest text in words or bytes.
const MAX: usize = 400;

/// The words of grammars.
const WORDS: [&str; 72] = [
    "axiom: ",
    "\naxiom: ",
    "\n",
    "\n",
    "\nF -> ",
    "\nA -> ",
    "\nA(x) : x > 1 -> ",
    "\nA(l, w) -> ",
    " -> ",
    " -0.5-> ",
    " -(0.5)-> ",
    " < ",
    " > ",
    ": ",
    "steps: 3\n",
    "\nsteps: ",
    "angle: 25\n",
    "dialect: hewitt\n",
    "\nparam ",
    "\nconst ",
    "\nmodule ",
    "\nignore: ",
    "let a = ",
    "; ",
    "for i in 0..",
    "for w in [",
    " in ",
    " search ",
    "rand(",
    "nrand(",
    "sin(",
    "min(",
    "atan2(",
    "F",
    "F(",
    "A",
    "A(",
    "A(x)",
    "A(1, 2)",
    "L(",
    "!",
    "!(",
    "+",
    "-",
    "&",
    "^",
    "/",
    "\\",
    "|",
    "$",
    "%",
    ".",
    "{",
    "}",
    "[",
    "]",
    "(",
    ")",
    ")",
    ", ",
    "1",
    "0",
    "0.5",
    "9",
    "1e300",
    "x",
    "i",
    " ? ",
    " : ",
    "&&",
    "==",
    "#",
];

/// Any bytes, or bytes that can be printed.
pub(super) fn bytes(draws: &mut Stream) -> Vec<u8> {
    let count = draws.below(MAX);
    let any = draws.chance(0.5);
    (0..count)
        .map(|_| match draws.below(12) {
            _ if any => draws.bits() as u8,
            0 => b'\n',
            _ => b' ' + draws.below(95) as u8,
        })
        .collect()
}

/// Words of the language.
pub(super) fn words(draws: &mut Stream) -> Vec<u8> {
    let mut text = String::new();
    if draws.chance(0.8) {
        text.push_str("axiom: F");
    }
    let most = if draws.chance(0.5) { MAX / 20 } else { MAX };
    for _ in 0..draws.below(most) {
        text.push_str(WORDS[draws.below(WORDS.len())]);
    }
    text.into_bytes()
}
