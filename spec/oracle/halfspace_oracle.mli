
val length : 'a1 list -> int

val app : 'a1 list -> 'a1 list -> 'a1 list

type comparison =
| Eq
| Lt
| Gt

val add : int -> int -> int

val eqb : bool -> bool -> bool

module Pos :
 sig
  val succ : int -> int

  val add : int -> int -> int

  val add_carry : int -> int -> int

  val pred_double : int -> int

  val compare_cont : comparison -> int -> int -> comparison

  val compare : int -> int -> comparison

  val eqb : int -> int -> bool
 end

val rev : 'a1 list -> 'a1 list

val existsb : ('a1 -> bool) -> 'a1 list -> bool

module Z :
 sig
  val double : int -> int

  val succ_double : int -> int

  val pred_double : int -> int

  val pos_sub : int -> int -> int

  val add : int -> int -> int

  val opp : int -> int

  val sub : int -> int -> int

  val compare : int -> int -> comparison

  val leb : int -> int -> bool

  val ltb : int -> int -> bool

  val gtb : int -> int -> bool

  val eqb : int -> int -> bool
 end

type side =
| KNegative
| KOn
| KPositive

type relation =
| RPositive
| RNegative
| RCoincident
| RSpanning

val opposite : side -> side

val side_eqb : side -> side -> bool

type booleanOp =
| KUnion
| KIntersection
| KDifference
| KSymmetricDifference

type solidClass =
| KInside
| KOutside
| KSame
| KOpposite

type keep =
| KDrop
| KKeep
| KFlip

type row = { and_a : keep; and_b : keep; or_a : keep; or_b : keep;
             minus_a : keep; minus_b : keep; xor_a : keep; xor_b : keep }

val table : solidClass -> row

val keep0 : booleanOp -> solidClass -> bool -> keep

val is_outside : solidClass -> bool

val same_class : solidClass -> solidClass -> bool

val class_in_plane : solidClass -> solidClass -> bool -> solidClass

type ('fragment, 'plane) bspTree =
| Nothing
| Node of 'plane * 'fragment list * ('fragment, 'plane) bspTree
   * ('fragment, 'plane) bspTree

val children_of : side -> 'a1 -> 'a1 -> 'a1 * 'a1

val shown_of : side -> 'a1 list -> 'a1 list

val back_to_front : ('a2 -> side) -> ('a1, 'a2) bspTree -> 'a1 list

val front_to_back : ('a2 -> side) -> ('a1, 'a2) bspTree -> 'a1 list

type span = { first : int; last : int }

type mergeCase =
| K1
| K2
| K3
| K4
| K5
| K6
| K7
| K8

val merge_case : span -> span -> mergeCase

type state = { objects : span list; unlit : span list; passed : span list;
               lit : span list; cases : mergeCase list }

val merge_segment : state -> state

val ended : state -> bool

val merge_lists : int -> state -> state

type merged = { newly_lit : span list; still_unlit : span list }

val begin_merge : span list -> span list -> state

val run_merge : span list -> span list -> state

val merge : span list -> span list -> merged

val is_side : side -> side -> bool

val relation_of : side list -> relation

type put = { part : side; at_ : int; crossing : bool; cut : bool }

val put0 : side -> int -> bool -> bool -> put

val step : int -> side -> side -> put list

val walk_from : side -> int -> side list -> put list

val walk : side list -> put list
