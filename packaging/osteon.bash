# Completion of osteon's commands and options, as its own --help lists them.
_osteon() {
  local word=${COMP_WORDS[COMP_CWORD]} help commands=() i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    [[ ${COMP_WORDS[i]} == -* ]] && break
    help=$(osteon "${commands[@]}" --help 2>/dev/null)
    grep -q "^  ${COMP_WORDS[i]} " <<<"$(sed -n '/^Subcommands:/,$p' <<<"$help")" || break
    commands+=("${COMP_WORDS[i]}")
  done
  help=$(osteon "${commands[@]}" --help 2>/dev/null)
  local found
  if [[ $word == -* ]]; then
    found=$(compgen -W "--quiet $(grep -o -- '--[a-z][a-z-]*' <<<"$help")" -- "$word")
  else
    found=$(compgen -W "$(sed -n '/^Subcommands:/,$p' <<<"$help" | grep -o '^  [a-z][a-z-]*')" -- "$word"
            compgen -f -- "$word")
  fi
  COMPREPLY=()
  [[ -z $found ]] || mapfile -t COMPREPLY <<<"$found"
}
complete -o filenames -F _osteon osteon
