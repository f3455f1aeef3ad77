(** What the oracle computes: the programs that spec/coq/ proves things of, as
    OCaml. tools/check_oracle.py compares what this gives with the files that
    stand beside it.

    Numbers become OCaml's integers of 63 bits: the oracle's are pixels,
    indices and sizes of lists. *)

From Coq Require Import Extraction ExtrOcamlBasic ExtrOcamlNatInt.
From Coq Require Import ExtrOcamlZInt.
From Halfspace Require Import Base Boolean Order Spans Split.

Extraction Language OCaml.
Extraction "halfspace_oracle.ml"
  Spans.run_merge Spans.merge
  Split.relation_of Split.walk
  Order.front_to_back Order.back_to_front
  Boolean.keep Boolean.class_in_plane.
