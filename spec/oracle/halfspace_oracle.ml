
(** val length : 'a1 list -> int **)

let rec length = function
| [] -> 0
| _ :: l' -> Stdlib.Int.succ (length l')

(** val app : 'a1 list -> 'a1 list -> 'a1 list **)

let rec app l m =
  match l with
  | [] -> m
  | a :: l1 -> a :: (app l1 m)

type comparison =
| Eq
| Lt
| Gt

(** val add : int -> int -> int **)

let rec add = (+)

(** val eqb : bool -> bool -> bool **)

let eqb b1 b2 =
  if b1 then b2 else if b2 then false else true

module Pos =
 struct
  (** val succ : int -> int **)

  let rec succ = Pervasives.succ

  (** val add : int -> int -> int **)

  let rec add = (+)

  (** val add_carry : int -> int -> int **)

  and add_carry x y =
    (fun f2p1 f2p f1 p ->
  if p<=1 then f1 () else if p mod 2 = 0 then f2p (p/2) else f2p1 (p/2))
      (fun p ->
      (fun f2p1 f2p f1 p ->
  if p<=1 then f1 () else if p mod 2 = 0 then f2p (p/2) else f2p1 (p/2))
        (fun q -> (fun p->1+2*p) (add_carry p q))
        (fun q -> (fun p->2*p) (add_carry p q))
        (fun _ -> (fun p->1+2*p) (succ p))
        y)
      (fun p ->
      (fun f2p1 f2p f1 p ->
  if p<=1 then f1 () else if p mod 2 = 0 then f2p (p/2) else f2p1 (p/2))
        (fun q -> (fun p->2*p) (add_carry p q))
        (fun q -> (fun p->1+2*p) (add p q))
        (fun _ -> (fun p->2*p) (succ p))
        y)
      (fun _ ->
      (fun f2p1 f2p f1 p ->
  if p<=1 then f1 () else if p mod 2 = 0 then f2p (p/2) else f2p1 (p/2))
        (fun q -> (fun p->1+2*p) (succ q))
        (fun q -> (fun p->2*p) (succ q))
        (fun _ -> (fun p->1+2*p) 1)
        y)
      x

  (** val pred_double : int -> int **)

  let rec pred_double x =
    (fun f2p1 f2p f1 p ->
  if p<=1 then f1 () else if p mod 2 = 0 then f2p (p/2) else f2p1 (p/2))
      (fun p -> (fun p->1+2*p) ((fun p->2*p) p))
      (fun p -> (fun p->1+2*p) (pred_double p))
      (fun _ -> 1)
      x

  (** val compare_cont : comparison -> int -> int -> comparison **)

  let rec compare_cont = fun c x y -> if x=y then c else if x<y then Lt else Gt

  (** val compare : int -> int -> comparison **)

  let compare = fun x y -> if x=y then Eq else if x<y then Lt else Gt

  (** val eqb : int -> int -> bool **)

  let rec eqb p q =
    (fun f2p1 f2p f1 p ->
  if p<=1 then f1 () else if p mod 2 = 0 then f2p (p/2) else f2p1 (p/2))
      (fun p0 ->
      (fun f2p1 f2p f1 p ->
  if p<=1 then f1 () else if p mod 2 = 0 then f2p (p/2) else f2p1 (p/2))
        (fun q0 -> eqb p0 q0)
        (fun _ -> false)
        (fun _ -> false)
        q)
      (fun p0 ->
      (fun f2p1 f2p f1 p ->
  if p<=1 then f1 () else if p mod 2 = 0 then f2p (p/2) else f2p1 (p/2))
        (fun _ -> false)
        (fun q0 -> eqb p0 q0)
        (fun _ -> false)
        q)
      (fun _ ->
      (fun f2p1 f2p f1 p ->
  if p<=1 then f1 () else if p mod 2 = 0 then f2p (p/2) else f2p1 (p/2))
        (fun _ -> false)
        (fun _ -> false)
        (fun _ -> true)
        q)
      p
 end

(** val rev : 'a1 list -> 'a1 list **)

let rec rev = function
| [] -> []
| x :: l' -> app (rev l') (x :: [])

(** val existsb : ('a1 -> bool) -> 'a1 list -> bool **)

let rec existsb f = function
| [] -> false
| a :: l0 -> (||) (f a) (existsb f l0)

module Z =
 struct
  (** val double : int -> int **)

  let double x =
    (fun f0 fp fn z -> if z=0 then f0 () else if z>0 then fp z else fn (-z))
      (fun _ -> 0)
      (fun p -> ((fun p->2*p) p))
      (fun p -> (~-) ((fun p->2*p) p))
      x

  (** val succ_double : int -> int **)

  let succ_double x =
    (fun f0 fp fn z -> if z=0 then f0 () else if z>0 then fp z else fn (-z))
      (fun _ -> 1)
      (fun p -> ((fun p->1+2*p) p))
      (fun p -> (~-) (Pos.pred_double p))
      x

  (** val pred_double : int -> int **)

  let pred_double x =
    (fun f0 fp fn z -> if z=0 then f0 () else if z>0 then fp z else fn (-z))
      (fun _ -> (~-) 1)
      (fun p -> (Pos.pred_double p))
      (fun p -> (~-) ((fun p->1+2*p) p))
      x

  (** val pos_sub : int -> int -> int **)

  let rec pos_sub x y =
    (fun f2p1 f2p f1 p ->
  if p<=1 then f1 () else if p mod 2 = 0 then f2p (p/2) else f2p1 (p/2))
      (fun p ->
      (fun f2p1 f2p f1 p ->
  if p<=1 then f1 () else if p mod 2 = 0 then f2p (p/2) else f2p1 (p/2))
        (fun q -> double (pos_sub p q))
        (fun q -> succ_double (pos_sub p q))
        (fun _ -> ((fun p->2*p) p))
        y)
      (fun p ->
      (fun f2p1 f2p f1 p ->
  if p<=1 then f1 () else if p mod 2 = 0 then f2p (p/2) else f2p1 (p/2))
        (fun q -> pred_double (pos_sub p q))
        (fun q -> double (pos_sub p q))
        (fun _ -> (Pos.pred_double p))
        y)
      (fun _ ->
      (fun f2p1 f2p f1 p ->
  if p<=1 then f1 () else if p mod 2 = 0 then f2p (p/2) else f2p1 (p/2))
        (fun q -> (~-) ((fun p->2*p) q))
        (fun q -> (~-) (Pos.pred_double q))
        (fun _ -> 0)
        y)
      x

  (** val add : int -> int -> int **)

  let add = (+)

  (** val opp : int -> int **)

  let opp = (~-)

  (** val sub : int -> int -> int **)

  let sub = (-)

  (** val compare : int -> int -> comparison **)

  let compare = fun x y -> if x=y then Eq else if x<y then Lt else Gt

  (** val leb : int -> int -> bool **)

  let leb x y =
    match compare x y with
    | Gt -> false
    | _ -> true

  (** val ltb : int -> int -> bool **)

  let ltb x y =
    match compare x y with
    | Lt -> true
    | _ -> false

  (** val gtb : int -> int -> bool **)

  let gtb x y =
    match compare x y with
    | Gt -> true
    | _ -> false

  (** val eqb : int -> int -> bool **)

  let eqb x y =
    (fun f0 fp fn z -> if z=0 then f0 () else if z>0 then fp z else fn (-z))
      (fun _ ->
      (fun f0 fp fn z -> if z=0 then f0 () else if z>0 then fp z else fn (-z))
        (fun _ -> true)
        (fun _ -> false)
        (fun _ -> false)
        y)
      (fun p ->
      (fun f0 fp fn z -> if z=0 then f0 () else if z>0 then fp z else fn (-z))
        (fun _ -> false)
        (fun q -> Pos.eqb p q)
        (fun _ -> false)
        y)
      (fun p ->
      (fun f0 fp fn z -> if z=0 then f0 () else if z>0 then fp z else fn (-z))
        (fun _ -> false)
        (fun _ -> false)
        (fun q -> Pos.eqb p q)
        y)
      x
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

(** val opposite : side -> side **)

let opposite = function
| KNegative -> KPositive
| KOn -> KOn
| KPositive -> KNegative

(** val side_eqb : side -> side -> bool **)

let side_eqb s t =
  match s with
  | KNegative -> (match t with
                  | KNegative -> true
                  | _ -> false)
  | KOn -> (match t with
            | KOn -> true
            | _ -> false)
  | KPositive -> (match t with
                  | KPositive -> true
                  | _ -> false)

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

(** val table : solidClass -> row **)

let table = function
| KInside ->
  { and_a = KKeep; and_b = KKeep; or_a = KDrop; or_b = KDrop; minus_a =
    KDrop; minus_b = KFlip; xor_a = KFlip; xor_b = KFlip }
| KOutside ->
  { and_a = KDrop; and_b = KDrop; or_a = KKeep; or_b = KKeep; minus_a =
    KKeep; minus_b = KDrop; xor_a = KKeep; xor_b = KKeep }
| KSame ->
  { and_a = KKeep; and_b = KDrop; or_a = KKeep; or_b = KDrop; minus_a =
    KDrop; minus_b = KDrop; xor_a = KDrop; xor_b = KDrop }
| KOpposite ->
  { and_a = KDrop; and_b = KDrop; or_a = KDrop; or_b = KDrop; minus_a =
    KKeep; minus_b = KDrop; xor_a = KDrop; xor_b = KDrop }

(** val keep0 : booleanOp -> solidClass -> bool -> keep **)

let keep0 operation solid_class first_operand =
  let row0 = table solid_class in
  (match operation with
   | KUnion -> if first_operand then row0.or_a else row0.or_b
   | KIntersection -> if first_operand then row0.and_a else row0.and_b
   | KDifference -> if first_operand then row0.minus_a else row0.minus_b
   | KSymmetricDifference -> if first_operand then row0.xor_a else row0.xor_b)

(** val is_outside : solidClass -> bool **)

let is_outside = function
| KOutside -> true
| _ -> false

(** val same_class : solidClass -> solidClass -> bool **)

let same_class c d =
  match c with
  | KInside -> (match d with
                | KInside -> true
                | _ -> false)
  | KOutside -> (match d with
                 | KOutside -> true
                 | _ -> false)
  | KSame -> (match d with
              | KSame -> true
              | _ -> false)
  | KOpposite -> (match d with
                  | KOpposite -> true
                  | _ -> false)

(** val class_in_plane : solidClass -> solidClass -> bool -> solidClass **)

let class_in_plane positive0 negative agrees =
  if same_class positive0 negative
  then positive0
  else let surface_agrees = is_outside positive0 in
       if eqb surface_agrees agrees then KSame else KOpposite

type ('fragment, 'plane) bspTree =
| Nothing
| Node of 'plane * 'fragment list * ('fragment, 'plane) bspTree
   * ('fragment, 'plane) bspTree

(** val children_of : side -> 'a1 -> 'a1 -> 'a1 * 'a1 **)

let children_of eye positive0 negative =
  match eye with
  | KNegative -> (negative, positive0)
  | _ -> (positive0, negative)

(** val shown_of : side -> 'a1 list -> 'a1 list **)

let shown_of eye coincident =
  match eye with
  | KOn -> []
  | _ -> coincident

(** val back_to_front : ('a2 -> side) -> ('a1, 'a2) bspTree -> 'a1 list **)

let rec back_to_front side_of_eye = function
| Nothing -> []
| Node (plane, coincident, positive0, negative) ->
  let eye = side_of_eye plane in
  let (near, far) =
    children_of eye (back_to_front side_of_eye positive0)
      (back_to_front side_of_eye negative)
  in
  app far (app (rev (shown_of eye coincident)) near)

(** val front_to_back : ('a2 -> side) -> ('a1, 'a2) bspTree -> 'a1 list **)

let rec front_to_back side_of_eye = function
| Nothing -> []
| Node (plane, coincident, positive0, negative) ->
  let eye = side_of_eye plane in
  let (near, far) =
    children_of eye (front_to_back side_of_eye positive0)
      (front_to_back side_of_eye negative)
  in
  app near (app (shown_of eye coincident) far)

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

(** val merge_case : span -> span -> mergeCase **)

let merge_case object0 unlit0 =
  if Z.ltb object0.last unlit0.first
  then K1
  else if Z.gtb object0.first unlit0.last
       then K8
       else let from_left = Z.leb object0.first unlit0.first in
            if Z.ltb object0.last unlit0.last
            then if from_left then K2 else K3
            else if Z.eqb object0.last unlit0.last
                 then if from_left then K4 else K5
                 else if from_left then K6 else K7

type state = { objects : span list; unlit : span list; passed : span list;
               lit : span list; cases : mergeCase list }

(** val merge_segment : state -> state **)

let merge_segment state0 =
  match state0.objects with
  | [] -> state0
  | object0 :: next_objects ->
    (match state0.unlit with
     | [] -> state0
     | k :: next_unlit ->
       let { first = i; last = j } = object0 in
       let { first = min; last = max } = k in
       let merged0 = fun objects0 unlit0 passed0 lit0 -> { objects =
         objects0; unlit = unlit0; passed = passed0; lit = lit0; cases =
         ((merge_case object0 k) :: state0.cases) }
       in
       (match merge_case object0 k with
        | K1 ->
          merged0 next_objects (k :: next_unlit) state0.passed state0.lit
        | K2 ->
          merged0 next_objects ({ first = (Z.add j 1); last =
            max } :: next_unlit) state0.passed ({ first = min; last =
            j } :: state0.lit)
        | K3 ->
          merged0 next_objects ({ first = (Z.add j 1); last =
            max } :: next_unlit) ({ first = min; last =
            (Z.sub i 1) } :: state0.passed) (object0 :: state0.lit)
        | K4 ->
          merged0 next_objects next_unlit state0.passed (k :: state0.lit)
        | K5 ->
          merged0 next_objects next_unlit ({ first = min; last =
            (Z.sub i 1) } :: state0.passed) ({ first = i; last =
            max } :: state0.lit)
        | K6 ->
          merged0 (object0 :: next_objects) next_unlit state0.passed
            (k :: state0.lit)
        | K7 ->
          merged0 (object0 :: next_objects) next_unlit ({ first = min; last =
            (Z.sub i 1) } :: state0.passed) ({ first = i; last =
            max } :: state0.lit)
        | K8 ->
          merged0 (object0 :: next_objects) next_unlit (k :: state0.passed)
            state0.lit))

(** val ended : state -> bool **)

let ended state0 =
  match state0.objects with
  | [] -> true
  | _ :: _ -> (match state0.unlit with
               | [] -> true
               | _ :: _ -> false)

(** val merge_lists : int -> state -> state **)

let rec merge_lists at_most state0 =
  (fun fO fS n -> if n=0 then fO () else fS (n-1))
    (fun _ -> state0)
    (fun fewer ->
    if ended state0 then state0 else merge_lists fewer (merge_segment state0))
    at_most

type merged = { newly_lit : span list; still_unlit : span list }

(** val begin_merge : span list -> span list -> state **)

let begin_merge objects0 unlit0 =
  { objects = objects0; unlit = unlit0; passed = []; lit = []; cases = [] }

(** val run_merge : span list -> span list -> state **)

let run_merge objects0 unlit0 =
  merge_lists (add (length objects0) (length unlit0))
    (begin_merge objects0 unlit0)

(** val merge : span list -> span list -> merged **)

let merge objects_ unlit_ =
  let state0 = run_merge objects_ unlit_ in
  { newly_lit = (rev state0.lit); still_unlit =
  (app (rev state0.passed) state0.unlit) }

(** val is_side : side -> side -> bool **)

let is_side =
  side_eqb

(** val relation_of : side list -> relation **)

let relation_of sides =
  let some_positive = existsb (is_side KPositive) sides in
  let some_negative = existsb (is_side KNegative) sides in
  if (&&) some_positive some_negative
  then RSpanning
  else if some_positive
       then RPositive
       else if some_negative then RNegative else RCoincident

type put = { part : side; at_ : int; crossing : bool; cut : bool }

(** val put0 : side -> int -> bool -> bool -> put **)

let put0 part0 k crossing0 cut0 =
  { part = part0; at_ = k; crossing = crossing0; cut = cut0 }

(** val step : int -> side -> side -> put list **)

let step k here there =
  match here with
  | KOn ->
    (put0 (opposite there) k false true) :: ((put0 there k false false) :: [])
  | _ ->
    (put0 here k false false) :: (if side_eqb there (opposite here)
                                  then (put0 here k true true) :: ((put0
                                                                    there k
                                                                    true
                                                                    false) :: [])
                                  else [])

(** val walk_from : side -> int -> side list -> put list **)

let rec walk_from first0 k = function
| [] -> []
| here :: rest ->
  (match rest with
   | [] -> step k here first0
   | there :: _ ->
     app (step k here there) (walk_from first0 (Stdlib.Int.succ k) rest))

(** val walk : side list -> put list **)

let walk sides = match sides with
| [] -> []
| first0 :: _ -> walk_from first0 0 sides
