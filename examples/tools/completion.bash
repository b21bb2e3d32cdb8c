# SPDX-License-Identifier: MIT
# Completion of Gnomon's programs for bash: options and techniques as --help names them, else file names.
_gnomon() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} help
  help=$("$1" --help 2>/dev/null)
  case $previous in
    --shadow) mapfile -t COMPREPLY < <(compgen -W "$(sed -n '/^SPEC/,/^  keys/s/^  \([a-z][a-z]*\)  .*/\1/p' <<<"$help")" -- "$current") ;;
    *)
      if [[ $current == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$(sed -n 's/^  \(--[a-z-]*\).*/\1/p' <<<"$help")" -- "$current")
      fi
      ;;
  esac
}
complete -o default -F _gnomon "${BASH_SOURCE[0]##*/}"
