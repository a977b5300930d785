# Draws docs/architecture.md's figure from the graph that rill-capture --graph writes: the passes up to
# the second correction, with an edge from the pass that wrote a buffer to each one that reads it.
# The command is in docs/architecture.md.
BEGIN {
  print "digraph passes {\n  node [shape=box, style=\"rounded,filled\", fillcolor=\"#eef4fa\", color=\"#2f6fab\", fontname=Helvetica, fontsize=11, height=0.3, margin=\"0.1,0.04\"];"
  print "  edge [color=\"#777777\", fontname=Helvetica, fontsize=8, fontcolor=\"#444444\", arrowsize=0.6];\n  ranksep=0.3;"
  left_out["fluid parameters"] = left_out["dispatch shapes"] = left_out["fluid control"] = 1
  # Nearly every pass uses these: drawn between a pass and the next one only.
  neighboring["dispatch commands"] = neighboring["fluid sums"] = 1
  # Written without being read.
  overwritten["predictions"] = overwritten["wall samples"] = overwritten["predictions and multipliers"] = 1
  # After the list has been built, for particles alone whose list is full.
  of_grid["cells"] = of_grid["cell starts"] = 1
}
function label(text) { sub(/.*label="/, "", text); sub(/(\\n|").*/, "", text); return text }

/^  p[0-9]+ \[/ {
  pass = $1; name[pass] = label($0); sub(/^[0-9]+ +/, "", name[pass])
  order[++passes] = pass
  if (name[pass] == "correct" && ++corrections == 2) last = passes
  next
}
/^  r[0-9]+ -> p/ { uses[++used] = "read " $3 " " $1; next }
/^  p[0-9]+ -> r/ { uses[++used] = "write " $1 " " $3; next }
/rank=same/ {
  count = split($0, part, ";")
  for (k = 1; k <= count; ++k) {
    if (!match(part[k], /r[0-9]+ \[/)) continue
    id = substr(part[k], RSTART, RLENGTH - 2)
    buffer[id] = label(part[k])
    if (part[k] ~ /\\n64 bytes/) left_out[buffer[id]] = 1  # the placeholder of an array that the scene has no use for
  }
}

END {
  if (!last) { print "passes.awk: expected two passes \"correct\", found " corrections + 0 >"/dev/stderr"; exit 1 }
  for (k = 1; k <= last; ++k) {
    drawn[order[k]] = 1
    before[order[k]] = k > 1 ? order[k - 1] : ""
    after_list[order[k]] = list_built
    if (name[order[k]] == "build list") list_built = 1
    print "  " order[k] " [label=\"" name[order[k]] "\"];"
    if (k > 1) print "  " order[k - 1] " -> " order[k] " [style=invis, weight=20];"
  }
  # Reads come before writes within a pass: a pass that writes what it reads is not its own source.
  for (k = 1; k <= used; ++k) {
    split(uses[k], use, " ")
    if (use[2] != now) { for (r in written) writer[r] = written[r]; split("", written); now = use[2] }
    if (!drawn[now] || left_out[buffer[use[3]]]) continue
    name_of = buffer[use[3]]
    shown = use[3] in writer && !((now, use[3]) in seen)
    if (use[1] == "write" && overwritten[name_of]) shown = 0
    if (neighboring[name_of] && writer[use[3]] != before[now]) shown = 0
    if (of_grid[name_of] && after_list[now]) shown = 0
    if (shown) {
      seen[now, use[3]] = 1
      edge = writer[use[3]] " -> " now
      if (!(edge in text)) edges[++drawn_edges] = edge
      text[edge] = text[edge] (text[edge] ? "\\n" : "") name_of
    }
    if (use[1] == "write") written[use[3]] = now
  }
  for (k = 1; k <= drawn_edges; ++k) print "  " edges[k] " [label=\"" text[edges[k]] "\"];"
  print "}"
}
