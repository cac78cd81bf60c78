//! What the help of `pleach fit` says below the options.

pub(super) const EXAMPLES: &str = "Examples:
  pleach fit targets/quaking_aspen.png  a minute; results in runs/quaking_aspen
  pleach fit photo.jpg --mask auto -v  a photograph of a tree before a sky
  pleach fit oak.jpg --trunks 1 --bare-height 0.2  what was read wrong in it
  pleach fit oak.jpg --height 18 --timeout 5m  a tree of 18 m, five minutes
  pleach fit goal.png --from random --optimizer hewitt --evaluations 20000
  pleach fit goal.png --robust 4  parameters of which every seed is like it
  pleach fit goal.png --from acer --free crown --free leaves --fix leaf_shape
  pleach fit goal.png --evolve-rules --timeout 2m  a grammar from nothing
  pleach fit goal.png --individual 2m --timeout 3m  longer for this very tree, branch by branch
  pleach fit goal.png --individuals 8  eight trees on one goal: depth is free
  pleach fit goal.png --posterior  an interval for each number, and eight trees from it
  pleach fit front.png --view 90=side.png --holdout-view 45=corner.png
  pleach fit goal.png --volume-from goal  a crown that follows the outline
  pleach fit front.png --view auto=other.png --free-frame  from who knows where
  pleach fit goal.png --out DIR --resume  go on after ctrl-C or a crash
  pleach fit goal.png --out DIR --continue --timeout 5m  search on
  pleach fit goals/*.png --out runs --timeout 2m  a batch: runs/summary.csv
  pleach fit goals/*.png --out runs --shard 2/8  goals 2, 10, 18 ..., for arrays
  pleach fit --list goals.csv --out runs  a height, view, mask ... for each goal

Likeness measures how much two silhouettes look like trees of one kind: where the ink is, how ragged \
the outline is, how thick the strokes and how large the gaps are. It is 1 for the same picture; a fit \
ends with what other trees of the species, trees of another species and an ellipse have for its goal, \
a verdict, and what to do next.

The run folder holds best.toml (a species file that `pleach grow` takes), best.png, overlay.png (grey is \
agreement, orange is missing, blue is too much), render.png, history.csv (a row per generation), \
parameters.csv (how well the goal determines each parameter), reading.json and reading.png (what is in the goal, as by \
`pleach read`) and summary.json; with --mask auto mask.png, \
with further views an overlay of each. That is the kind; individual.toml is this very tree, whose branches \
were re-sampled one by one until they lie on the picture, with individual.png, overlay-individual.png and \
individual-render.png. With --individuals there are individual-2.toml and so on, and individuals.png, a sheet of \
all trees from the front and from the side. With --posterior there are posterior.csv, for each number of the prior \
its interval before and since the picture was seen, and posterior.png, trees that the picture may be of, the species \
files of which are posterior-1.toml and so on. Most of them are written while the search runs, too. The file \
`checkpoint` is there while a fit is unfinished, `search-state` once it is finished, for --continue.

A finished fit is replaced only by a fit of the same goal with the same options, or with --overwrite, and \
only once the new one is complete; until then that one is in the folder `unfinished` inside.

Asked to stop (ctrl-C), a fit writes what it has found and ends with code 130; --resume goes on with it \
and gives the same result as an uninterrupted fit. The first guess, the judging of the result, and the search for \
this very tree are then made again.

With several goals, the budget is for each. A goal that fails is named and the others go on. With --resume \
a batch goes on where it stopped, and skips what was finished with the same options; with others it is \
refused. Several processes may fit one batch at a time, each goal is then fitted by one of them; \
`pleach collect` joins what they leave.

A --list is a CSV file with a header: the column `file`, and any of `height`, `view`, `mask`, `tree`, \
`ground_row`, `axis_column`, `leaves`, `trunks`, `trunk_width`, `lean` and `bare_height`; an empty cell means the option of the command line. Paths are \
relative to the list.";
