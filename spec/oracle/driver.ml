(* Answers questions on standard input, one a line, with one line each on
   standard output; all are numbers. A list is its length and its members.

   0 objects unlit         cases, newly lit, still unlit; spans are two numbers
   1 sides                 relation; if it is spanning, the corners of the
                           positive part and of the negative: the edge that
                           leaves, -1 if it is the plane's, and the vertex, -1
                           if it is a crossing
   2 tree                  front to back, back to front; a tree is 0, or 1, the
                           eye's side, fragments, positive tree, negative tree
   3 operation class first keep
   4 positive negative agrees  class in plane
   5 sides                 as 1, without the vertices

   Sides are -1, 0, 1; all else is numbered as in the headers of spec/. *)

open Halfspace_oracle

let room = Bytes.create 65536
let filled = ref 0
let at = ref 0

(* The next character, or a line feed at the end. *)
let next_char () =
  if !at >= !filled then begin
    filled := input stdin room 0 (Bytes.length room);
    at := 0
  end;
  if !filled = 0 then '\n'
  else begin
    let c = Bytes.unsafe_get room !at in
    incr at;
    c
  end

let rec read_digits value =
  match next_char () with
  | '0' .. '9' as c -> read_digits (value * 10 + Char.code c - 48)
  | _ -> value

let rec read_int () =
  match next_char () with
  | '-' -> - (read_digits 0)
  | '0' .. '9' as c -> read_digits (Char.code c - 48)
  | _ -> if !filled = 0 then raise End_of_file else read_int ()

let read_list read =
  let count = read_int () in
  let rec go n = if n = 0 then [] else let v = read () in v :: go (n - 1) in
  go count

let read_span () =
  let first = read_int () in
  let last = read_int () in
  { first; last }

let read_side () =
  match read_int () with
  | -1 -> KNegative | 0 -> KOn | 1 -> KPositive
  | _ -> failwith "no side"

let rec read_tree () =
  match read_int () with
  | 0 -> Nothing
  | _ ->
    let eye = read_side () in
    let fragments = read_list read_int in
    let positive = read_tree () in
    let negative = read_tree () in
    Node (eye, fragments, positive, negative)

let answer = Buffer.create 65536

let write n =
  Buffer.add_string answer (string_of_int n);
  Buffer.add_char answer ' '

let write_list write_one l =
  write (List.length l);
  List.iter write_one l

let write_span s = write s.first; write s.last

let number_of_case = function
  | K1 -> 1 | K2 -> 2 | K3 -> 3 | K4 -> 4
  | K5 -> 5 | K6 -> 6 | K7 -> 7 | K8 -> 8

let number_of_relation = function
  | RPositive -> 0 | RNegative -> 1 | RCoincident -> 2 | RSpanning -> 3

let classes = [| KInside; KOutside; KSame; KOpposite |]

let number_of_class c =
  match c with KInside -> 0 | KOutside -> 1 | KSame -> 2 | KOpposite -> 3

let number_of_keep = function KDrop -> 0 | KKeep -> 1 | KFlip -> 2

let operations =
  [| KUnion; KIntersection; KDifference; KSymmetricDifference |]

let answer_merge () =
  let objects = read_list read_span in
  let unlit = read_list read_span in
  let merged = merge objects unlit in
  write_list (fun k -> write (number_of_case k))
    (rev (run_merge objects unlit).cases);
  write_list write_span merged.newly_lit;
  write_list write_span merged.still_unlit

let answer_split ~with_vertices =
  let sides = read_list read_side in
  let relation = relation_of sides in
  write (number_of_relation relation);
  if relation = RSpanning then begin
    let puts = walk sides in
    let write_part side =
      write_list
        (fun p ->
          write (if p.cut then -1 else p.at_);
          if with_vertices then write (if p.crossing then -1 else p.at_))
        (List.filter (fun p -> p.part = side) puts) in
    write_part KPositive;
    write_part KNegative
  end

let answer_tree () =
  let tree = read_tree () in
  let side_of_eye side = side in
  write_list write (front_to_back side_of_eye tree);
  write_list write (back_to_front side_of_eye tree)

let answer_keep () =
  let operation = operations.(read_int ()) in
  let solid_class = classes.(read_int ()) in
  let first_operand = read_int () <> 0 in
  write (number_of_keep (keep0 operation solid_class first_operand))

let answer_class () =
  let positive = classes.(read_int ()) in
  let negative = classes.(read_int ()) in
  let agrees = read_int () <> 0 in
  write (number_of_class (class_in_plane positive negative agrees))

let () =
  try
    while true do
      (match read_int () with
       | 0 -> answer_merge ()
       | 1 -> answer_split ~with_vertices:true
       | 2 -> answer_tree ()
       | 3 -> answer_keep ()
       | 4 -> answer_class ()
       | 5 -> answer_split ~with_vertices:false
       | _ -> failwith "no such question");
      Buffer.add_char answer '\n';
      if Buffer.length answer > 60000 then begin
        print_string (Buffer.contents answer);
        Buffer.clear answer
      end
    done
  with End_of_file -> print_string (Buffer.contents answer)
